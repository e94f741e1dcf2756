// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string_view>

#include "kiln/brdf/fresnel.h"

namespace kiln {

/// Schlick's reflectance less a dip before grazing incidence, as metals have it:
///
///     F = F0 + (F90 - F0)(1 - c)^5 - a c (1 - c)^6,   clamped to [0,1]
template <class F>
struct DippedSchlick {
  F f0, f90;
  F dip;  ///< a

  /// The dip that takes `missing` from Schlick's reflectance at the cosine 1/7.
  static F dip_of(F missing) {
    constexpr double dip_82 = cosine_82 * (1 - cosine_82) * (1 - cosine_82) * (1 - cosine_82) *
                              (1 - cosine_82) * (1 - cosine_82) * (1 - cosine_82);
    return missing * F(1 / dip_82);
  }

  /// Schlick's reflectance at the cosine 1/7.
  static F schlick_82(F f0, F f90) { return lerp(f0, f90, grazing_weight(F(cosine_82))); }

  F eval(F cosine) const {
    const F c = clamp(cosine, F(0), F(1));
    const F w = grazing_weight(c);
    return clamp(fma(-dip * c, w * (F(1) - c), lerp(f0, f90, w)), F(0), F(1));
  }

  /// F0 + (F90 - F0) / 21 - a / 126 where nothing was clamped; by quadrature.
  /// @accuracy exact where nothing was clamped, else 1e-3
  F average() const { return fresnel_average<F>(*this); }
};

/// F82-tint: the dip is given by a tint of Schlick's reflectance at the cosine 1/7.
/// @source Kutz, Hasan and Edmondson 2021, "Novel Aspects of the Adobe Standard Material"
template <class F>
struct F82Tint : DippedSchlick<F> {
  static constexpr std::string_view name = "f82-tint";
  static constexpr std::string_view summary = "Schlick with a tint at 82 degrees, for metals";
  static constexpr std::string_view source = "Kutz, Hasan & Edmondson 2021; OpenPBR";
  static constexpr std::array params = {
      f0_param, f90_param, ModelParam{"f82", 0, 1, 1, "tint of the reflectance at 82 degrees"}};

  static F82Tint make(const FresnelChannel<F>& channel) {
    using Base = DippedSchlick<F>;
    const F at_82 = Base::schlick_82(channel.f0, channel.f90);
    return {{channel.f0, channel.f90, Base::dip_of(at_82 * (F(1) - channel.f82))}};
  }
};

/// Hoffman's form: the reflectance at the cosine 1/7 itself is given.
/// @source Hoffman 2019, "Fresnel Equations Considered Harmful"
template <class F>
struct HoffmanF82 : DippedSchlick<F> {
  static constexpr std::string_view name = "hoffman-f82";
  static constexpr std::string_view summary = "Schlick through a given reflectance at 82 degrees";
  static constexpr std::string_view source = "Hoffman 2019";
  static constexpr std::array params = {f0_param, f90_param,
                                        ModelParam{"f82", 0, 1, 1, "reflectance at 82 degrees"}};

  static HoffmanF82 make(const FresnelChannel<F>& channel) {
    using Base = DippedSchlick<F>;
    const F at_82 = Base::schlick_82(channel.f0, channel.f90);
    return {{channel.f0, channel.f90, Base::dip_of(at_82 - channel.f82)}};
  }
};

}  // namespace kiln
