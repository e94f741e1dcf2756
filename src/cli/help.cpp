// SPDX-License-Identifier: Apache-2.0
#include "help.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

namespace kiln {
namespace {

constexpr size_t columns = 100;
constexpr size_t indent = 26;  ///< where meanings begin

/// Words from column `indent` on, as many lines as they need.
std::string wrapped(const std::string& text) {
  std::istringstream words(text);
  std::string lines, line;
  for (std::string word; words >> word;) {
    if (!line.empty() && indent + line.size() + 1 + word.size() > columns) {
      lines += line + "\n" + std::string(indent, ' ');
      line.clear();
    }
    line += (line.empty() ? "" : " ") + word;
  }
  return lines + line;
}

// "-o, --output DIR"
std::string spelled(const CLI::Option& option) {
  std::string name = option.get_name(false, true);
  name = name.substr(0, name.find('{'));  // the value that a flag stands for
  if (const size_t comma = name.find(','); comma != std::string::npos) name.insert(comma + 1, " ");
  const std::string type = option.get_type_name();
  return type.empty() ? name : name + " " + type;
}

std::string line_of(const CLI::Option& option) {
  const std::string name = "  " + spelled(option);
  const std::string gap(name.size() + 2 <= indent ? indent - name.size() : 2, ' ');
  return name + gap + wrapped(option.get_description()) + "\n";
}

/// The options of a group by their names alone.
std::string named_options(const CLI::App& app, const std::string& group, const std::string& title,
                          const std::string& source) {
  std::string names;
  for (const CLI::Option* option : app.get_options()) {
    if (option->get_group() == group) names += spelled(*option) + ", ";
  }
  if (names.empty()) return "";
  names.resize(names.size() - 2);
  return fmt::format("  {:<{}}", title, indent - 2) +
         wrapped("choices and ranges by " + source + ": " + names) + "\n";
}

}  // namespace

std::string overview() {
  std::string text = "kiln bakes spatially varying BRDFs: tables, environments and previews.\n\n";
  for (const Verb& verb : all_verbs()) {
    text += fmt::format("  kiln {:<37} {}\n", verb.name + " " + verb.arguments, verb.summary);
  }
  text +=
      "\nkiln VERB --help tells the options of a verb, kiln --version the version.\n"
      "Results go to stdout, progress and messages to stderr.\n\n"
      "Exit codes: 0 ok, 1 some tasks failed, 2 usage or bad pipeline file, 3 input missing or\n"
      "unreadable, 5 output not writable, 6 internal error, 7 difference found, 33 out of memory,\n"
      "130 and 143 interrupted.\n";
  return text;
}

std::string help_of(const Verb& verb, const CLI::App& app) {
  std::string text = fmt::format("kiln {} {}\n{}\n\n", verb.name, verb.arguments, verb.summary);
  for (const CLI::Option* option : app.get_options()) {
    const std::string group = option->get_group();
    if (group == every_verb || group == of_the_surface || group == of_the_environment) continue;
    text += line_of(*option);
  }
  text += "\n";
  text += named_options(app, of_the_environment, "environment", "kiln env --help");
  text += named_options(app, of_the_surface, "surface (kiln list)", "kiln list surface");
  text +=
      "\nOf every verb: -h, --help; --json, the result for machines; -q, --quiet; -v, --verbose;\n"
      "-j, --threads N; --max-memory SIZE; --ocio FILE, a config over the file's; --isa "
      "auto|avx2;\n"
      "--color auto|always|never\n";
  return text;
}

}  // namespace kiln
