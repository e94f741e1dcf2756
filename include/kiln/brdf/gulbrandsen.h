// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string_view>

#include "kiln/brdf/conductor.h"

namespace kiln {

/// The exact reflectance of a metal whose n and k follow from two artists' numbers, the reflectance
/// r at normal incidence and an edge tint g:
///
///     n = (1 - g)(1 + sqrt r) / (1 - sqrt r) + g (1 - r) / (1 + r)
///     k^2 = (r (n + 1)^2 - (n - 1)^2) / (1 - r)
///
/// @valid  r in [0, 0.999], g in [0,1]; clamped
/// @source Gulbrandsen 2014, "Artist Friendly Metallic Fresnel"
template <class F>
struct Gulbrandsen {
  static constexpr std::string_view name = "gulbrandsen";
  static constexpr std::string_view summary = "exact metal of a reflectance and an edge tint";
  static constexpr std::string_view source = "Gulbrandsen 2014";
  static constexpr std::array params = {
      ModelParam{"f0", 0, 0.999, 0.04, "reflectance at normal incidence"},
      ModelParam{"edge_tint", 0, 1, 0, "bias toward grazing incidence"}};

  Conductor<F> metal;

  static Gulbrandsen make(const FresnelChannel<F>& channel) {
    const F r = clamp(channel.f0, F(0), F(0.999)), root = sqrt(r);
    const F greatest = (F(1) + root) / (F(1) - root), least = (F(1) - r) / (F(1) + r);
    const F n = lerp(greatest, least, clamp(channel.edge_tint, F(0), F(1)));
    // r (n + 1)^2 - (n - 1)^2, factored.
    const F up = root * (n + F(1)), down = n - F(1);
    const F k2 = (up - down) * (up + down) / (F(1) - r);
    return {{n, safe_sqrt(k2)}};
  }

  F eval(F cosine) const { return metal.eval(cosine); }

  /// Average over the hemisphere of directions, see Conductor.
  F average() const { return metal.average(); }
};

}  // namespace kiln
