// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <vector>

#include "kiln/brdf/ggx.h"
#include "kiln/light/prefilter.h"
#include "kiln/light/straight_lobe.h"
#include "kiln/math/wide.h"

namespace kiln {

/// The lobe of prefiltering under normal = view = direction, up to a factor,
///
///     K(c) = D(h) c    if c > 0, else 0,    c = d.w,    n.h = sqrt((1 + c) / 2)
///
/// in terms of s = |d - w|^2 / 4, c = 1 - 2 s, where nothing cancels at the peak: h leans from n by
/// the angle of sine sqrt(s).
/// @param distribution  isotropic
/// @source Karis 2013, "Real Shading in Unreal Engine 4"
template <class Distribution, class F>
F lobe_at(const Distribution& distribution, F s) {
  const Vec3<F> h{sqrt(s), F(0), safe_sqrt(F(1) - s)};
  return distribution.D(h) * max(fma(F(-2), s, F(1)), F(0));
}

/// The same for GGX, D = alpha^2 / (pi (s + alpha^2 (1 - s))^2): without roots it is cheaper, and
/// keeps the digits that the peak of a bright lamp shows.
template <class F>
F lobe_at(const Ggx<F>& distribution, F s) {
  const F alpha2 = distribution.alpha_x * distribution.alpha_y;
  const F base = fma(alpha2, F(1) - s, s);
  return max(fma(F(-2), s, F(1)), F(0)) * (alpha2 * F(1 / pi)) / (base * base);
}

/// GGX with its masking toward w instead of the cosine (FilterLobe::masked).
template <class F>
struct MaskedGgx {
  F alpha2;
};

template <class F>
F lobe_at(const MaskedGgx<F>& lobe, F s) {
  return straight_lobe(lobe.alpha2, fma(F(-2), s, F(1)), s);
}

/// K at each s in [0, 1].
std::vector<double> lobe_values(const FilterLobe& lobe, std::span<const double> s);

/// Directions with R, G, B and one more number each, side by side for wide numbers. Padded to whole
/// ones by directions without power. A coordinate is the sum of a float and a rest, for near a
/// narrow lobe's peak the last bit of a float shows.
struct PointMasses {
  std::array<std::vector<float>, 3> direction, rest;
  std::array<std::vector<float>, 4> power;

  size_t size() const { return direction[0].size(); }
  /// Makes room for so many, padding included, without power.
  void reset(size_t count);
  void set(size_t at, const Vec3<double>& toward, const std::array<double, 4>& of);
};

using MassSums = std::array<float, 4>;

/// Adds the sum of K(d.w) power(w) over padded masses to sums[i], for each direction d.
/// @accuracy  1e-6 of the sum of absolute terms for up to 4096 masses
void add_masses(const FilterLobe& lobe, const PointMasses& masses,
                std::span<const Vec3<double>> directions, std::span<MassSums> sums);

}  // namespace kiln
