// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace kiln::test {

struct ReferenceValue {
  std::string model;
  std::string mu, roughness, alpha;  ///< as written; may be empty
  std::string quantity;
  double value;
};

/// The rows of a table of reference values: model,mu,perceptual_roughness,alpha,quantity,value,...
inline std::vector<ReferenceValue> read_reference_values(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  std::vector<ReferenceValue> values;
  while (std::getline(file, line)) {
    std::stringstream cells(line);
    ReferenceValue v;
    std::string value;
    std::getline(cells, v.model, ',');
    std::getline(cells, v.mu, ',');
    std::getline(cells, v.roughness, ',');
    std::getline(cells, v.alpha, ',');
    std::getline(cells, v.quantity, ',');
    std::getline(cells, value, ',');
    char* end = nullptr;
    v.value = std::strtod(value.c_str(), &end);
    if (end != value.c_str()) values.push_back(v);
  }
  return values;
}

}  // namespace kiln::test
