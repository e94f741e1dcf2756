// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string_view>

#include "kiln/brdf/fresnel.h"

namespace kiln {

/// Schlick's Fresnel reflectance, F0 + (F90 - F0)(1 - c)^5 with c the cosine at the microfacet.
/// @source Schlick 1994
template <class F>
struct Schlick {
  static constexpr std::string_view name = "schlick";
  static constexpr std::string_view summary = "Schlick's Fresnel approximation (F0, F90)";
  static constexpr std::string_view source = "Schlick 1994";
  static constexpr std::array params = {f0_param, f90_param};

  F f0, f90;

  static Schlick make(const FresnelChannel<F>& channel) { return {channel.f0, channel.f90}; }

  /// The weight of F90: (1 - c)^5.
  static F grazing_weight(F cosine) { return kiln::grazing_weight(cosine); }

  /// @return [0..1]
  F eval(F cosine) const { return lerp(f0, f90, grazing_weight(cosine)); }

  /// Average over the hemisphere of directions, 2 INT F(c) c dc = F0 + (F90 - F0) / 21.
  F average() const { return lerp(f0, f90, F(1.0 / 21)); }
};

/// Schlick's Fresnel of a colour.
template <class F>
PerChannel<Schlick<F>> schlick_of(const Vec3<F>& f0, F f90) {
  return {{f0.x, f90}, {f0.y, f90}, {f0.z, f90}};
}

}  // namespace kiln
