// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "fourier.h"
#include "harmonic_analysis.h"
#include "legendre.h"
#include "sphere_field.h"
#include "synthetic.h"
#include "zonal_kernel.h"

namespace kiln {
namespace {

using test::random_direction;
using test::random_unit;

Spectrum random_numbers(int n) {
  Spectrum x(n);
  for (size_t i = 0; i < x.re.size(); ++i) {
    x.re[i] = random_unit(0, static_cast<std::uint32_t>(2 * i)) - 0.5;
    x.im[i] = random_unit(0, static_cast<std::uint32_t>(2 * i + 1)) - 0.5;
  }
  return x;
}

TEST(FourierTransform, IsItsDefiningSumForAnyLength) {
  for (const int n : {1, 2, 3, 8, 12, 31, 64, 97, 100}) {
    const Spectrum x = random_numbers(n);
    Spectrum found = x;
    Fourier(n).forward(found);
    for (int k = 0; k < n; ++k) {
      double re = 0, im = 0;
      for (int j = 0; j < n; ++j) {
        const double angle = -2 * pi * (static_cast<long long>(j) * k % n) / n;
        const auto at = static_cast<size_t>(j);
        re += x.re[at] * std::cos(angle) - x.im[at] * std::sin(angle);
        im += x.re[at] * std::sin(angle) + x.im[at] * std::cos(angle);
      }
      EXPECT_NEAR(found.re[static_cast<size_t>(k)], re, 1e-12) << n;
      EXPECT_NEAR(found.im[static_cast<size_t>(k)], im, 1e-12) << n;
    }
  }
}

TEST(FourierTransform, IsUndoneByItsInverse) {
  for (const int n : {256, 100}) {
    const Spectrum x = random_numbers(n);
    Spectrum found = x;
    const Fourier fourier(n);
    fourier.forward(found);
    fourier.inverse(found);
    for (size_t i = 0; i < x.re.size(); ++i) {
      EXPECT_NEAR(found.re[i] / n, x.re[i], 1e-14);
      EXPECT_NEAR(found.im[i] / n, x.im[i], 1e-14);
    }
  }
}

TEST(ZonalKernel, OfTheWidestLobeIsThatOfTheClampedCosine) {
  // At alpha = 1 the lobe is max(c, 0), with k_l = A_l / pi.
  const ZonalKernel kernel = expand_ggx_lobe(1, 1e-6, 400);
  EXPECT_NEAR(kernel.integral, pi, 1e-12);
  ASSERT_GT(kernel.order(), 4);
  const std::array<double, 5> expected = {1, 2.0 / 3, 0.25, 0, -1.0 / 24};
  for (size_t l = 0; l < expected.size(); ++l) EXPECT_NEAR(kernel.factor[l], expected[l], 1e-13);
}

TEST(ZonalKernel, AddsUpToTheLobe) {
  for (const double alpha : {0.02, 0.1, 0.5}) {
    const ZonalKernel kernel = expand_ggx_lobe(alpha, 1e-6, 1800);
    for (const double c : {1.0, 0.999, 0.9, 0.4, -0.5}) {
      double sum = 0, previous = 0, current = 1;
      for (int l = 0; l <= kernel.order(); ++l) {
        sum += (2 * l + 1) / (4 * pi) * kernel.factor[static_cast<size_t>(l)] * current;
        const double next = ((2 * l + 1) * c * current - l * previous) / (l + 1);
        previous = current;
        current = next;
      }
      const double peak = ggx_lobe(0.0, alpha * alpha);
      EXPECT_NEAR(sum * kernel.integral, ggx_lobe((1 - c) / 2, alpha * alpha), 3e-4 * peak)
          << alpha << " " << c;
    }
  }
}

TEST(LegendreColumn, IsOrthonormalOnTheSphere) {
  const RingPairs rings(2000);
  for (const int m : {0, 1, 7, 40}) {
    const LegendreColumn column(m, 60);
    double norm = 0;
    for (int pair = 0; pair < rings.count; ++pair) {
      const auto at = static_cast<size_t>(pair);
      double p = column.seed_factor * std::pow(rings.sine[at], m), q = 0;
      for (size_t i = 1; i < column.scale.size(); ++i) {
        const double next = column.scale[i] * rings.cosine[at] * p - column.back[i] * q;
        q = p;
        p = next;
      }
      norm += 2 * p * p * rings.sine[at] * pi / rings.rings;
    }
    EXPECT_NEAR(2 * pi * norm, 1, 1e-4) << m;
  }
}

TEST(HarmonicAnalysis, FindsTheHarmonicsOfPointMasses) {
  // A single texel: a_lm = L conj(Y_lm) dw, whose squares add up to (2l + 1)/(4 pi) per band.
  for (const Size size : {Size{64, 32}, Size{50, 27}}) {
    std::vector<std::vector<double>> rows(static_cast<size_t>(size.height),
                                          std::vector<double>(static_cast<size_t>(3 * size.width)));
    const int x = 11, y = size.height / 2;
    for (size_t c = 0; c < 3; ++c) {
      rows[static_cast<size_t>(y)][static_cast<size_t>(3 * x) + c] =
          static_cast<double>(c + 1) / latlong_texel_solid_angle(size, y);
    }
    const Expansion found = analyse(size, rows, 20);
    for (int l = 0; l <= 20; ++l) {
      for (size_t c = 0; c < 3; ++c) {
        double sum = 0;
        for (int m = 0; m <= l; ++m) {
          const ColorCoefficient& a =
              found.columns[static_cast<size_t>(m)][static_cast<size_t>(l - m)];
          sum += (m == 0 ? 1 : 2) * (square(a.re[c]) + square(a.im[c]));
        }
        EXPECT_NEAR(sum, square(c + 1.0) * (2 * l + 1) / (4 * pi), 1e-11) << l;
      }
    }
  }
}

TEST(SphereField, InterpolatesSmoothFunctionsEvenAcrossThePoles) {
  SphereField field(64);
  const auto smooth = [](const Vec3<double>& d) {
    return std::array<double, 4>{1.0, d.x * d.y, 3 * d.z + d.y, std::exp(d.x - d.z)};
  };
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 128; ++x) {
      const auto values = smooth(test::texel_direction({128, 64}, x, y));
      for (size_t c = 0; c < 4; ++c) field.texel(x, y)[c] = static_cast<float>(values[c]);
    }
  }
  field.fill_border();
  std::vector<Vec3<double>> directions = {{0, 1, 0}, {0, -1, 0}, {0, 0, -1}, {1e-9, 0, -1}};
  for (std::uint32_t i = 0; i < 1000; ++i) directions.push_back(random_direction(0, i));
  for (const Vec3<double>& d : directions) {
    const auto found = field.at(d);
    const auto expected = smooth(d);
    for (size_t c = 0; c < 4; ++c) EXPECT_NEAR(found[c], expected[c], 3e-6);
  }
}

}  // namespace
}  // namespace kiln
