// SPDX-License-Identifier: Apache-2.0
#include "material_documents.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "document_formats.h"
#include "kiln/core/names.h"

namespace kiln {
namespace {

namespace fs = std::filesystem;

// Names become parts of output paths.
std::string safe_name(std::string name) {
  std::replace_if(
      name.begin(), name.end(), [](char c) { return c == '/' || c == '\\' || c < ' '; }, '_');
  return name == "." || name == ".." ? "_" : name;
}

void name_materials(const fs::path& file, std::vector<DocumentMaterial>& materials) {
  std::set<std::string> taken;
  for (size_t i = 0; i < materials.size(); ++i) {
    std::string& name = materials[i].set.name;
    name = safe_name(name);
    if (name.empty()) name = file.stem().string();
    if (taken.count(name)) name += fmt::format("_{}", i);
    taken.insert(name);
  }
}

}  // namespace

bool is_material_document(const fs::path& path) {
  const std::string extension = kebab(path.extension().string());
  return extension == ".gltf" || extension == ".glb" || extension == ".mtlx";
}

std::vector<PlannedSet> document_sets(const fs::path& file, const WorkflowSettings& reading) {
  const bool is_mtlx = kebab(file.extension().string()) == ".mtlx";
  std::vector<DocumentMaterial> materials = is_mtlx ? mtlx_materials(file) : gltf_materials(file);
  if (materials.empty()) {
    throw Error(Fault::Input, fmt::format("{}: no material in it", file.string()));
  }
  name_materials(file, materials);
  std::vector<PlannedSet> sets;
  for (DocumentMaterial& material : materials) {
    const Workflow workflow = material.set.reading.workflow;
    material.set.reading = reading;
    material.set.reading.workflow = workflow;
    if (reading.wrap == WrapChoice::Auto && material.wrap) {
      material.set.reading.wrap = static_cast<WrapChoice>(static_cast<int>(*material.wrap) + 1);
    }
    material.set.source = file.string();
    sets.push_back(std::move(material.set));
  }
  return sets;
}

}  // namespace kiln
