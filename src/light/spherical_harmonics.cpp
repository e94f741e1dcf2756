// SPDX-License-Identifier: Apache-2.0
#include "kiln/light/spherical_harmonics.h"

#include "color_planes.h"
#include "kiln/core/error.h"
#include "kiln/image/projection.h"
#include "kiln/parallel/rows.h"

namespace kiln {
namespace {

size_t index_of(int l, int m) { return static_cast<size_t>(l * l + l + m); }

// One column of the triangle: Y_lm and Y_l-m for all l >= m, by the recurrence of the orthonormal
// Legendre functions divided by sin(theta)^m. `re + i im` is (x + i y)^m times the seed of the
// column, so that nothing is singular at the poles.
void fill_column(int order, int m, double z, double re, double im, std::vector<double>& values) {
  double previous = 0, current = 1, before = 0;
  for (int l = m; l <= order; ++l) {
    if (l > m) {
      const double ll = l, mm = m;
      const double a = std::sqrt((4 * ll * ll - 1) / (ll * ll - mm * mm));
      const double next = a * (z * current - before * previous);
      previous = current;
      current = next;
      before = 1 / a;
    }
    values[index_of(l, m)] = current * re;
    if (m > 0) values[index_of(l, -m)] = current * im;
  }
}

void fill_harmonics(int order, const Vec3<double>& d, std::vector<double>& values) {
  double re = std::sqrt(0.25 / pi), im = 0;
  for (int m = 0; m <= order; ++m) {
    if (m > 0) {
      // P_mm / P_m-1,m-1 = sqrt((2m + 1) / (2m)) sin(theta); sqrt(2) once for m > 0.
      const double grow = std::sqrt((2.0 * m + 1) / (2.0 * m)) * (m == 1 ? std::sqrt(2.0) : 1.0);
      const double turned = grow * (re * d.x - im * d.y);
      im = grow * (re * d.y + im * d.x);
      re = turned;
    }
    fill_column(order, m, d.z, re, im, values);
  }
}

}  // namespace

std::vector<double> harmonics_at(int order, const Vec3<double>& d) {
  std::vector<double> values(static_cast<size_t>((order + 1) * (order + 1)));
  fill_harmonics(order, d, values);
  return values;
}

SphericalHarmonics project_sh(const Layers& latlong, int order) {
  if (order < 0) throw Error(Fault::Usage, "spherical harmonics of order " + std::to_string(order));
  const ColorPlanes colors = color_planes(latlong);
  const Size size = colors.size;
  const int count = (order + 1) * (order + 1);
  const auto sums = sum_rows(size.height, 3 * count, [&](int y, std::vector<double>& share) {
    std::vector<double> values(static_cast<size_t>(count));
    for (int x = 0; x < size.width; ++x) {
      const Vec3<double> radiance = colors.at(x, y);
      const Vec2<double> uv{(x + 0.5) / size.width, (y + 0.5) / size.height};
      fill_harmonics(order, latlong_to_direction(uv), values);
      for (size_t i = 0; i < values.size(); ++i) {
        share[3 * i] += values[i] * radiance.x;
        share[3 * i + 1] += values[i] * radiance.y;
        share[3 * i + 2] += values[i] * radiance.z;
      }
    }
    const double solid_angle = latlong_texel_solid_angle(size, y);
    for (double& sum : share) sum *= solid_angle;
  });
  SphericalHarmonics result{order, std::vector<Vec3<double>>(static_cast<size_t>(count))};
  for (size_t i = 0; i < result.coefficients.size(); ++i) {
    result.coefficients[i] = {sums[3 * i], sums[3 * i + 1], sums[3 * i + 2]};
  }
  return result;
}

SphericalHarmonics irradiance_over_pi(const SphericalHarmonics& radiance) {
  SphericalHarmonics result = radiance;
  double even = 1;  // |A_l| / pi of even l, times (l - 1)(l + 2) / 2
  for (int l = 0; l <= radiance.order; ++l) {
    double factor = l == 1 ? 2.0 / 3 : 0.0;
    if (l % 2 == 0) {
      if (l > 0) even *= -(l - 1.0) / l;
      factor = l == 0 ? 1.0 : -2 * even / ((l - 1.0) * (l + 2.0));
    }
    for (int m = -l; m <= l; ++m) {
      result.coefficients[index_of(l, m)] = radiance.coefficients[index_of(l, m)] * factor;
    }
  }
  return result;
}

Vec3<double> evaluate(const SphericalHarmonics& sum, const Vec3<double>& d) {
  const auto values = harmonics_at(sum.order, d);
  Vec3<double> result;
  for (size_t i = 0; i < values.size(); ++i) result += sum.coefficients[i] * values[i];
  return result;
}

}  // namespace kiln
