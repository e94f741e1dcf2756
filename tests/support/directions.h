// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "kiln/math/vec.h"

namespace kiln::test {

/// The unit direction with cosine mu at azimuth phi.
inline Vec3<double> direction(double mu, double phi) {
  const double sine = std::sqrt((1 - mu) * (1 + mu));
  return {sine * std::cos(phi), sine * std::sin(phi), mu};
}

/// n directions spread over the upper hemisphere along a spiral, from grazing to straight up.
inline std::vector<Vec3<double>> hemisphere(int n) {
  std::vector<Vec3<double>> directions;
  for (int i = 0; i < n; ++i) directions.push_back(direction((i + 0.5) / n, 2.399963 * i));
  return directions;
}

template <class F>
Vec3<F> as(const Vec3<double>& v) {
  return {F(static_cast<ScalarOf<F>>(v.x)), F(static_cast<ScalarOf<F>>(v.y)),
          F(static_cast<ScalarOf<F>>(v.z))};
}

/// The first lane of a number of any type.
inline double first_lane(double x) { return x; }
inline double first_lane(float x) { return x; }
inline double first_lane(WideFloat x) { return x.get(0); }

}  // namespace kiln::test
