// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "kiln/math/vec.h"

namespace kiln {

/// Schlick's Fresnel reflectance, F0 + (F90 - F0)(1 - c)^5 with c the cosine at the microfacet.
/// @source Schlick 1994
template <class F>
struct Schlick {
  static constexpr std::string_view name = "schlick";
  static constexpr std::string_view summary = "Schlick's Fresnel approximation (F0, F90)";
  static constexpr std::string_view source = "Schlick 1994";

  Vec3<F> f0;
  F f90;

  /// The weight of F90: (1 - c)^5.
  static F grazing_weight(F cosine) { return pow5(clamp(F(1) - cosine, F(0), F(1))); }

  /// @return [0..1] per channel
  Vec3<F> eval(F cosine) const {
    const F w = grazing_weight(cosine);
    return {lerp(f0.x, f90, w), lerp(f0.y, f90, w), lerp(f0.z, f90, w)};
  }

  /// Average over the hemisphere of directions, 2 INT F(c) c dc = F0 + (F90 - F0) / 21.
  Vec3<F> average() const {
    const F w(1.0 / 21);
    return {lerp(f0.x, f90, w), lerp(f0.y, f90, w), lerp(f0.z, f90, w)};
  }
};

}  // namespace kiln
