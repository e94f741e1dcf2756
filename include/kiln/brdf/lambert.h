// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string_view>

#include "kiln/brdf/fujii.h"

namespace kiln {

/// Lambert's diffuse reflection: the same radiance in every direction.
template <class F>
struct Lambert {
  static constexpr std::string_view name = "lambert";
  static constexpr std::string_view summary = "ideal diffuse reflection";
  static constexpr std::string_view source = "Lambert 1760";
  /// Its albedo is the same from every direction, so energy coupling can be exact.
  static constexpr bool constant_albedo = true;
  static constexpr std::array params = {color_param};
  static constexpr bool reciprocal = true;
  static constexpr bool has_albedo = true;
  static constexpr bool closed_albedo = true;
  static constexpr double greatest_albedo = 1;

  Vec3<F> color;  ///< reflectance [0..1]
  F roughness;    ///< not read

  /// f_r [1/sr], without the cosine.
  Vec3<F> eval(const Vec3<F>&, const Vec3<F>&) const { return color * F(1 / pi); }

  /// Reflected share of the light that comes from (or goes to) a direction with cosine mu.
  Vec3<F> albedo(F) const { return color; }
};

}  // namespace kiln
