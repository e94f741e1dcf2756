// SPDX-License-Identifier: Apache-2.0
#include "kiln/light/spherical_harmonics.h"

#include <span>

#include "color_planes.h"
#include "kiln/core/error.h"
#include "kiln/image/projection.h"
#include "kiln/math/sums.h"
#include "kiln/math/wide.h"
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

// cos(k phi) and sin(k phi) at texel centres, for each k up to the order.
struct Waves {
  std::vector<std::vector<double>> cosine, sine;  ///< [order + 1][width padded]

  Waves(int width, int order) {
    for (int k = 0; k <= order; ++k) {
      cosine.emplace_back();
      sine.emplace_back();
      for (int x = 0; x < width; ++x) {
        const double angle_rad = 2 * pi * k * ((x + 0.5) / width - 0.5);
        cosine.back().push_back(std::cos(angle_rad));
        sine.back().push_back(std::sin(angle_rad));
      }
    }
  }
};

/// A row as 2 n + 1 masses at even azimuths, which have the same Fourier coefficients up to n, and
/// so the same integral against every harmonic up to that order.
std::vector<Vec3<double>> masses_of_row(const ColorPlanes& latlong, int y, const Waves& waves) {
  const size_t order = waves.cosine.size() - 1, count = 2 * order + 1;
  std::vector<Vec3<double>> masses(count);
  for (size_t k = 0; k <= order; ++k) {
    std::array<double, 3> even, odd;
    for (size_t c = 0; c < 3; ++c) {
      even[c] = weighted_sum(latlong.planes[c]->texels_of_row(y), waves.cosine[k]);
      odd[c] = weighted_sum(latlong.planes[c]->texels_of_row(y), waves.sine[k]);
    }
    for (size_t p = 0; p < count; ++p) {
      const double angle_rad = 2 * pi * static_cast<double>(k * p) / static_cast<double>(count);
      const double twice = (k == 0 ? 1.0 : 2.0) / static_cast<double>(count);
      const double cosine = twice * std::cos(angle_rad), sine = twice * std::sin(angle_rad);
      masses[p] += Vec3<double>{even[0], even[1], even[2]} * cosine +
                   Vec3<double>{odd[0], odd[1], odd[2]} * sine;
    }
  }
  return masses;
}

}  // namespace

std::vector<double> harmonics_at(int order, const Vec3<double>& d) {
  std::vector<double> values(static_cast<size_t>((order + 1) * (order + 1)));
  fill_harmonics(order, d, values);
  return values;
}

SphericalHarmonics project_sh(const Layers& latlong, int order, const Axes& axes,
                              double rotate_deg) {
  if (order < 0) throw Error(Fault::Usage, "spherical harmonics of order " + std::to_string(order));
  const ColorPlanes colors = color_planes(latlong);
  const Size size = colors.size;
  const Waves waves(size.width, order);
  const int count = (order + 1) * (order + 1);
  const auto sums = sum_rows(size.height, 3 * count, [&](int y, std::vector<double>& share) {
    std::vector<double> values(static_cast<size_t>(count));
    const std::vector<Vec3<double>> masses = masses_of_row(colors, y, waves);
    const double solid_angle = latlong_texel_solid_angle(size, y);
    for (size_t p = 0; p < masses.size(); ++p) {
      const Vec3<double> mass = masses[p] * solid_angle;
      const double u =
          0.5 + static_cast<double>(p) / static_cast<double>(masses.size()) - rotate_deg / 360;
      const Vec3<double> d = latlong_to_direction(Vec2<double>{u, (y + 0.5) / size.height});
      fill_harmonics(order, axes.to_engine(d), values);
      for (size_t i = 0; i < values.size(); ++i) {
        share[3 * i] += values[i] * mass.x;
        share[3 * i + 1] += values[i] * mass.y;
        share[3 * i + 2] += values[i] * mass.z;
      }
    }
  });
  SphericalHarmonics result{order, std::vector<Vec3<double>>(static_cast<size_t>(count))};
  for (size_t i = 0; i < result.coefficients.size(); ++i) {
    result.coefficients[i] = {sums[3 * i], sums[3 * i + 1], sums[3 * i + 2]};
  }
  return result;
}

Vec3<double> mean_of(const SphericalHarmonics& sum) {
  return sum.coefficients.front() * (1 / std::sqrt(4 * pi));
}

SphericalHarmonics up_to(int order, const SphericalHarmonics& sum) {
  const auto end = sum.coefficients.begin() + (order + 1) * (order + 1);
  return {order, {sum.coefficients.begin(), end}};
}

SphericalHarmonics windowed(const SphericalHarmonics& sum, ShWindow window) {
  SphericalHarmonics result = sum;
  for (int l = 1; l <= sum.order && window != ShWindow::None; ++l) {
    const double angle_rad = pi * l / (sum.order + 1);
    const double factor = window == ShWindow::Hann ? 0.5 * (1 + std::cos(angle_rad))
                                                   : std::sin(angle_rad) / angle_rad;
    for (int m = -l; m <= l; ++m) {
      result.coefficients[index_of(l, m)] = sum.coefficients[index_of(l, m)] * factor;
    }
  }
  return result;
}

std::array<Vec3<double>, 9> scaled_for_shaders(const SphericalHarmonics& sum) {
  const double first = std::sqrt(3 / (4 * pi)), second = std::sqrt(15 / (4 * pi));
  const std::array<double, 9> constants = {
      std::sqrt(1 / (4 * pi)),  first,  first,       first, second, second,
      std::sqrt(5 / (16 * pi)), second, 0.5 * second};
  std::array<Vec3<double>, 9> scaled;
  for (size_t i = 0; i < 9; ++i) scaled[i] = sum.coefficients[i] * constants[i];
  return scaled;
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
