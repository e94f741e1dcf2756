// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace kiln {

/// A number that the user of a model chooses.
struct ModelParam {
  std::string_view name;  ///< as in pipeline files and options
  double min, max, initial;
  std::string_view meaning;
};

/// The parameters that most distributions share.
inline constexpr ModelParam alpha_x_param{"alpha_x", 1e-4, 1, 0.25, "width along the tangent"};
inline constexpr ModelParam alpha_y_param{"alpha_y", 1e-4, 1, 0.25, "width along the bitangent"};
inline constexpr ModelParam alpha_param{"alpha", 1e-4, 1, 0.25, "width, roughness squared"};

}  // namespace kiln
