// SPDX-License-Identifier: Apache-2.0
// Paints the texture sets and environments that the project ships.
//
//     kiln_textures FOLDER [NAME...]      every set and environment, or those named
#include <algorithm>
#include <functional>
#include <iostream>
#include <string>
#include <vector>

#include "environments.h"
#include "kiln/core/error.h"
#include "kiln/core/names.h"
#include "surface.h"

namespace kiln::textures {
namespace {

struct Work {
  std::string name;
  std::function<void(const std::filesystem::path&)> write;
};

std::vector<Work> all_works() {
  std::vector<Work> works;
  for (const Set& set :
       {brushed_steel(), glazed_tiles(), rusted_iron(), woven_fabric(), painted_panel()}) {
    works.push_back({set.folder, [set](const auto& folder) { write_set(set, folder); }});
  }
  for (const Surroundings& place : {studio(), sky()}) {
    works.push_back(
        {place.name, [place](const auto& folder) { write_surroundings(place, folder); }});
  }
  return works;
}

void paint(const std::filesystem::path& folder, const std::vector<std::string>& names) {
  const std::vector<Work> works = all_works();
  std::vector<std::string> known;
  for (const Work& work : works) known.push_back(work.name);
  for (const std::string& name : names) {
    if (std::find(known.begin(), known.end(), name) == known.end()) {
      throw Error(Fault::Usage, unknown_name("texture set", name, known));
    }
  }
  for (const Work& work : works) {
    if (!names.empty() && std::find(names.begin(), names.end(), work.name) == names.end()) continue;
    std::cout << work.name << std::endl;
    work.write(folder);
  }
}

}  // namespace
}  // namespace kiln::textures

int main(int count, char** words) {
  if (count < 2) {
    std::cerr << "usage: kiln_textures FOLDER [NAME...]\n";
    return kiln::exit_code(kiln::Fault::Usage);
  }
  try {
    kiln::textures::paint(words[1], {words + 2, words + count});
    return 0;
  } catch (const kiln::Error& error) {
    std::cerr << "kiln_textures: " << error.what() << '\n';
    return kiln::exit_code(error.fault());
  }
}
