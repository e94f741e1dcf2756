// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "kiln/brdf/schlick.h"

namespace kiln {

// What a specular lobe reflects in total, and how the rest of a surface makes room for it. These
// formulas need integrals of the lobe; they take them by value and never look anything up.

/// The split-sum terms of a lobe for one direction: it reflects F0 * scale + F90 * bias.
template <class F>
struct SplitSumTerms {
  F scale, bias;
  F total() const { return scale + bias; }  ///< E, the albedo with F = 1
};

/// The terms for the two directions of an evaluation and their cosine-weighted average.
template <class F>
struct Albedo {
  SplitSumTerms<F> o, i, average;
};

/// Colour of the light that bounces more than once between microfacets, per unit of light that the
/// single-bounce lobe loses: F_ms = F_avg^2 E_avg / (1 - F_avg (1 - E_avg)).
/// @source Kulla and Conty 2017, with the first bounce counted once (F_avg squared)
template <class F>
F multiple_scattering_color(F fresnel_average, F albedo_average) {
  return square(fresnel_average) * albedo_average /
         max(F(1) - fresnel_average * (F(1) - albedo_average), F(1e-7));
}

/// Multiple scattering of a microfacet lobe with F = 1 [1/sr]; reciprocal.
///
///     f_ms = (1 - E(mu_o))(1 - E(mu_i)) / (pi (1 - E_avg))
///
/// @source Kulla and Conty 2017; Kelemen and Szirmay-Kalos 2001
template <class F>
F multiple_scattering(const Albedo<F>& albedo) {
  const F lost_o = max(F(1) - albedo.o.total(), F(0));
  const F lost_i = max(F(1) - albedo.i.total(), F(0));
  const F lost_average = max(F(1) - albedo.average.total(), F(1e-6));
  return lost_o * lost_i / (F(pi) * lost_average);
}

/// One channel of a specular lobe with Schlick's Fresnel, as far as energy is concerned.
template <class F>
struct SpecularChannel {
  F f0, f90;
  F multiple;  ///< F_ms, 0 without multiple scattering

  /// Total reflectance for the direction of these terms.
  F reflectance(const SplitSumTerms<F>& terms) const {
    return fma(f0, terms.scale, fma(f90, terms.bias, multiple * (F(1) - terms.total())));
  }
};

/// Weight of a diffuse lobe under a specular one; reciprocal.
///
/// A lobe of constant albedo takes (1 - R(mu_i))(1 - R(mu_o)) / (1 - R_avg): then a white diffuse
/// colour makes the total 1 exactly. For any other lobe that quotient can exceed the energy there
/// is, so it takes min(1 - R(mu_i), 1 - R(mu_o)), which never reflects more than 1 - R(mu_o) of
/// the lobe's albedo. R is the reflectance of the channel with the greatest F0, for all channels
/// alike, so the diffuse colour keeps its hue.
///
/// @source Kelemen and Szirmay-Kalos 2001 (exact form)
template <class F>
F coupling(const SpecularChannel<F>& greatest, const Albedo<F>& albedo, bool constant_albedo) {
  const F left_o = clamp(F(1) - greatest.reflectance(albedo.o), F(0), F(1));
  const F left_i = clamp(F(1) - greatest.reflectance(albedo.i), F(0), F(1));
  if (!constant_albedo) return min(left_o, left_i);
  const F left_average = max(F(1) - greatest.reflectance(albedo.average), F(1e-6));
  return left_o * left_i / left_average;
}

}  // namespace kiln
