// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "directions.h"
#include "kiln/integrate/gauss_legendre.h"

namespace kiln::test {

/// Integral over the upper hemisphere by Gauss-Legendre in cosine times midpoint in azimuth; for
/// smooth integrands.
template <class Integrand>
double integrate_hemisphere(const Integrand& f, int cosines = 64, int azimuths = 128) {
  const Rule rule = gauss_legendre(cosines);
  double sum = 0;
  for (int i = 0; i < cosines; ++i) {
    for (int j = 0; j < azimuths; ++j) {
      const double phi = 2 * pi * (j + 0.5) / azimuths;
      sum += rule.weights[i] * 2 * pi / azimuths * f(direction(rule.nodes[i], phi));
    }
  }
  return sum;
}

}  // namespace kiln::test
