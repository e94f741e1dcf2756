// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string_view>

#include "kiln/brdf/model_param.h"
#include "kiln/brdf/slopes.h"

namespace kiln {

/// Student's t-distribution of microfacet slopes: shape 2 is GGX, shape to infinity Beckmann.
template <class F>
struct StudentT {
  static constexpr std::string_view name = "student-t";
  static constexpr std::string_view summary =
      "Student's t slopes, from GGX (shape 2) to Beckmann (large shapes)";
  static constexpr std::string_view source = "Ribardiere et al. 2017";
  static constexpr double default_shape = 3;
  static constexpr std::array params = {
      alpha_x_param, alpha_y_param,
      ModelParam{"shape", 1.51, 40, default_shape, "heaviness of the tail; 2 is GGX"}};
  static constexpr bool anisotropic = true;
  static constexpr bool alpha_is_width = true;
  static constexpr bool has_lambda = false;
  static constexpr bool exact_lambda = false;

  F alpha_x, alpha_y;
  F shape;  ///< g

  static StudentT make(F alpha_x, F alpha_y, F shape) { return {alpha_x, alpha_y, shape}; }
  static StudentT isotropic(F alpha) { return {alpha, alpha, F(default_shape)}; }

  /// Density of microfacet normals.
  ///
  ///     D(m) = (1 + q / (g - 1))^-g / (pi ax ay mz^4),   q = ((mx/ax)^2 + (my/ay)^2) / mz^2
  ///          = e^-g mz^(2 (g - 2)) / (pi ax ay),         e = mz^2 + q mz^2 / (g - 1)
  ///
  /// if mz > 0, else 0.
  ///
  /// @return    [1/sr], >= 0; integrates to 1 against wm.z over the hemisphere
  /// @valid     alpha_x, alpha_y in [1e-4, 1], g > 1.5
  /// @accuracy  float vs double: relative error (16 + 4 g (1 + ln e)) ulp
  F D(const Vec3<F>& wm) const {
    const F x = wm.x / alpha_x, y = wm.y / alpha_y;
    const F z2 = max(wm.z * wm.z, F(1e-30));
    const F e = fma(x, x, y * y) / (shape - F(1)) + z2;
    const F power = fma(shape - F(2), log(z2), -shape * log(e));
    return select(wm.z > F(0), exp(power) / (F(pi) * alpha_x * alpha_y), F(0));
  }

  /// A microfacet normal with density D(wm) wm.z: t^2 = (g - 1)((1 - u)^(1 / (1 - g)) - 1) in
  /// stretched slopes.
  /// @param u  uniform in (0,1)^2
  Vec3<F> sample(const Vec2<F>& u) const {
    const F tail = shape - F(1);
    const F t = sqrt(tail * expm1(-log1p(-u.y) / tail)), phi = F(2 * pi) * u.x;
    return normal_of_slopes(alpha_x * t * cos(phi), alpha_y * t * sin(phi));
  }
};

}  // namespace kiln
