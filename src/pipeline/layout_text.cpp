// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "kiln/bake/pack_layout.h"
#include "kiln/core/names.h"
#include "kiln/pipeline/pipeline.h"
#include "kiln/pipeline/schema.h"

namespace kiln {
namespace {

namespace fs = std::filesystem;

bool is_document(const fs::path& path) {
  const std::string extension = kebab(path.extension().string());
  return extension == ".yaml" || extension == ".yml" || extension == ".json";
}

/// "engines.yaml#mobile", in two.
struct Reference {
  fs::path file;
  std::string name;  ///< empty: the only one
};

Reference reference_of(const std::string& text) {
  const size_t mark = std::min(text.rfind('#'), text.size());
  return {text.substr(0, mark), mark < text.size() ? text.substr(mark + 1) : ""};
}

// Every layout of the file is checked, whichever is wanted.
void check_layouts(const Node& layouts, Mistakes& mistakes) {
  for (const Entry& layout : layouts.entries) {
    for (const Entry& file : layout.value.find("files")->entries) {
      attempt(mistakes, file.value.place,
              [&] { parse_layout(file.key + " = " + file.value.text); });
    }
  }
}

const Node& chosen(const Node& layouts, const Reference& reference) {
  std::vector<std::string> names;
  for (const Entry& entry : layouts.entries) names.push_back(entry.key);
  if (names.empty()) throw Error(Fault::Usage, shown(layouts.place) + "found no layout");
  if (reference.name.empty()) {
    if (names.size() == 1) return layouts.entries.front().value;
    throw Error(Fault::Usage,
                fmt::format("layout: {} holds {}: {}; expected one of them, as {}#{}",
                            reference.file.string(), names.size(), fmt::join(names, ", "),
                            reference.file.string(), names.front()));
  }
  if (const Node* layout = layouts.find(reference.name)) return *layout;
  throw Error(Fault::Usage, fmt::format("{}: {}", reference.file.string(),
                                        unknown_name("layout", reference.name, names)));
}

std::string text_of(const Node& layout) {
  std::string text;
  for (const Entry& file : layout.find("files")->entries) {
    text += fmt::format("{}{} = {}", text.empty() ? "" : "; ", file.key, file.value.text);
  }
  return text;
}

}  // namespace

std::string layout_text(const std::string& text, const fs::path& folder) {
  if (text.empty() || text.find('=') != std::string::npos) return text;
  const Reference reference = reference_of(text);
  if (!is_document(reference.file)) return find_pack_preset(text).layout;
  const Node root = read_document(joined(folder, reference.file.string()));
  Mistakes mistakes;
  check(root, "layouts-file", mistakes);
  mistakes.raise();
  const Node& layouts = *root.find("layouts");
  check_layouts(layouts, mistakes);
  mistakes.raise();
  return text_of(chosen(layouts, reference));
}

}  // namespace kiln
