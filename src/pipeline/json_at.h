// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "kiln/core/error.h"

namespace kiln {

using Json = nlohmann::json;

/// @param file  the name that messages give
/// @error Fault::Input, "FILE:LINE:COLUMN: what is wrong"
Json parse_json(const std::string& text, const std::string& file);

/// A value in a JSON document, and where it stands: "materials[2].normalTexture". Wrong types are
/// errors of Fault::Input that say so; what is missing is nothing, or the default.
class JsonAt {
 public:
  JsonAt(const Json& value, std::string file) : value_(&value), file_(std::move(file)) {}

  const std::string& where() const { return where_; }
  bool is_object() const { return value_->is_object(); }
  std::vector<std::string> keys() const;

  /// The member of that name.
  std::optional<JsonAt> find(const std::string& key) const;
  /// The elements of the array of that name, none where it is missing.
  std::vector<JsonAt> items(const std::string& key) const;
  double number(const std::string& key, double missing) const;
  std::optional<size_t> index(const std::string& key) const;
  std::string text(const std::string& key, const std::string& missing = {}) const;
  template <size_t N>
  std::array<float, N> numbers(const std::string& key, std::array<float, N> missing) const {
    const std::optional<std::vector<double>> found = list(key, N);
    for (size_t i = 0; found && i < N; ++i) missing[i] = static_cast<float>((*found)[i]);
    return missing;
  }

  [[noreturn]] void refuse(const std::string& message) const;

 private:
  JsonAt(const Json& value, std::string file, std::string where)
      : value_(&value), file_(std::move(file)), where_(std::move(where)) {}
  std::optional<std::vector<double>> list(const std::string& key, size_t count) const;

  const Json* value_;
  std::string file_;
  std::string where_;
};

}  // namespace kiln
