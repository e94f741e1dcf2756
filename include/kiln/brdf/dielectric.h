// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string_view>

#include "kiln/brdf/fresnel.h"

namespace kiln {

/// Chebyshev coefficients, in 8 (n - 1) - 1, of the part of the average reflectance without the
/// logarithm of n - 1, divided by n - 1; for n in [1, 1.25], where its closed form cancels.
inline constexpr std::array<double, 14> dielectric_average_terms = {
    0.408852768277480583,    0.0680245799125654553,    -0.0072849587837442619,
    0.000221422202719431661, 0.0000100118691331407651, -1.43890585870767202e-6,
    7.40572083270942169e-8,  -1.24739522109872314e-9,  -1.12737105523671361e-10,
    1.14323639853350614e-11, -5.34654215952620472e-13, 1.00091890827819345e-14,
    5.69144032827257835e-16, -6.32502281770894867e-17};

/// Exact Fresnel reflectance of an interface between dielectrics, unpolarised.
template <class F>
struct Dielectric {
  static constexpr std::string_view name = "dielectric";
  static constexpr std::string_view summary = "exact Fresnel reflectance of a dielectric";
  static constexpr std::string_view source = "Fresnel 1823; Walter et al. 2007 (form)";
  static constexpr std::array params = {ior_param};

  F ior;  ///< n of the far side over n of the near side; below 1 from inside

  static Dielectric make(const FresnelChannel<F>& channel) { return {channel.ior}; }

  /// With g^2 = n^2 - 1 + c^2,
  ///
  ///     F = 1/2 ((g - c) / (g + c))^2 (1 + ((c (g + c) - 1) / (c (g - c) + 1))^2)
  ///
  /// and 1 where g^2 <= 0, total internal reflection. g - c is (n^2 - 1) / (g + c).
  F eval(F cosine) const {
    const F c = clamp(cosine, F(0), F(1));
    const F contrast = (ior - F(1)) * (ior + F(1));
    const F g2 = fma(c, c, contrast);
    const F g = safe_sqrt(g2);
    const F sum = max(g + c, F(1e-15)), difference = contrast / sum;
    const F senkrecht = square(difference / sum);
    const F ratio = fma(c, sum, F(-1)) / fma(c, difference, F(1));
    const F reflected = F(0.5) * senkrecht * fma(ratio, ratio, F(1));
    return select(g2 > F(0), min(reflected, F(1)), F(1));
  }

  /// Average over the hemisphere of directions, in closed form; from inside
  /// 1 - (1 - F_avg(1/n)) n^2.
  /// @accuracy double 1e-14, float 2e-6, for n in [0.05, 20]
  /// @source   Walsh 1926; Duntley 1942
  F average() const {
    const F outside = average_outside(max(ior, F(1) / ior));
    return select(ior < F(1), F(1) - (F(1) - outside) * square(ior), outside);
  }

 private:
  // n^2 (n^2 - 1)^2 / (n^2 + 1)^3 ln((n - 1) / (n + 1)) plus the rest.
  static F average_outside(F n) {
    const F d = n - F(1), n2 = n * n;
    const F contrast = d * (n + F(1));
    const F logarithm = log(max(d, F(1e-30)) / (n + F(1)));
    const F first = n2 * square(contrast) / (square(n2 + F(1)) * (n2 + F(1))) * logarithm;
    return first + select(d < F(0.25), rest_near_one(d), rest(n));
  }

  static F rest(F n) {
    const F n2 = n * n, n4 = n2 * n2, up = n2 + F(1), down = max(n4 - F(1), F(1e-3));
    const F rational = F(0.5) + (n - F(1)) * fma(F(3), n, F(1)) / (F(6) * square(n + F(1)));
    const F second = F(2) * n2 * n * fma(n, n + F(2), F(-1)) / (up * down);
    const F third = F(8) * n4 * (n4 + F(1)) / (up * square(down)) * log(n);
    return rational - second + third;
  }

  static F rest_near_one(F d) {
    const F s = fma(F(8), d, F(-1)), twice = s + s;
    F sum = F(0), before = F(0);
    for (size_t k = dielectric_average_terms.size() - 1; k > 0; --k) {
      const F next = fma(twice, sum, F(dielectric_average_terms[k]) - before);
      before = sum;
      sum = next;
    }
    return d * fma(s, sum, F(dielectric_average_terms[0]) - before);
  }
};

}  // namespace kiln
