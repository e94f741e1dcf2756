// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "fourier.h"
#include "harmonic_analysis.h"
#include "legendre.h"
#include "lobe.h"
#include "sphere_field.h"
#include "synthetic.h"
#include "zonal_kernel.h"

namespace kiln {
namespace {

using test::random_direction;
using test::random_unit;

constexpr int lanes = lane_count<WideDouble>;

/// In every lane numbers of its own.
Spectrum random_numbers(int n) {
  Spectrum x(n);
  for (size_t i = 0; i < x.re.size(); ++i) {
    double re[lanes], im[lanes];
    for (int lane = 0; lane < lanes; ++lane) {
      const auto number = static_cast<std::uint32_t>(2 * (static_cast<int>(i) * lanes + lane));
      re[lane] = random_unit(0, number) - 0.5;
      im[lane] = random_unit(0, number + 1) - 0.5;
    }
    x.re[i] = load_lanes<WideDouble>(re);
    x.im[i] = load_lanes<WideDouble>(im);
  }
  return x;
}

TEST(FourierTransform, IsItsDefiningSumForAnyLengthInEveryLane) {
  for (const int n : {1, 2, 3, 4, 8, 12, 31, 64, 97, 100, 128}) {
    const Spectrum x = random_numbers(n);
    Spectrum found = x, scratch;
    Fourier(n).forward(found, scratch);
    for (int k = 0; k < n; ++k) {
      WideDouble re(0.0), im(0.0);
      for (int j = 0; j < n; ++j) {
        const double angle = -2 * pi * (static_cast<long long>(j) * k % n) / n;
        const auto at = static_cast<size_t>(j);
        const WideDouble c(std::cos(angle)), s(std::sin(angle));
        re = re + x.re[at] * c - x.im[at] * s;
        im = im + x.re[at] * s + x.im[at] * c;
      }
      for (size_t lane = 0; lane < lanes; ++lane) {
        EXPECT_NEAR(found.re[static_cast<size_t>(k)].get(lane), re.get(lane), 1e-12) << n;
        EXPECT_NEAR(found.im[static_cast<size_t>(k)].get(lane), im.get(lane), 1e-12) << n;
      }
    }
  }
}

TEST(FourierTransform, IsUndoneByItsInverse) {
  for (const int n : {256, 128, 100}) {
    const Spectrum x = random_numbers(n);
    Spectrum found = x, scratch;
    const Fourier fourier(n);
    fourier.forward(found, scratch);
    fourier.inverse(found, scratch);
    for (size_t i = 0; i < x.re.size(); ++i) {
      for (size_t lane = 0; lane < lanes; ++lane) {
        EXPECT_NEAR(found.re[i].get(lane) / n, x.re[i].get(lane), 1e-14);
        EXPECT_NEAR(found.im[i].get(lane) / n, x.im[i].get(lane), 1e-14);
      }
    }
  }
}

TEST(ZonalKernel, OfTheWidestLobeIsThatOfTheClampedCosine) {
  // At alpha = 1 the lobe is max(c, 0), with k_l = A_l / pi.
  const ZonalKernel kernel = expand_lobe({.alpha = 1}, 1e-6, 400);
  // D is 1 / pi throughout.
  EXPECT_NEAR(kernel.integral, 1, 1e-12);
  ASSERT_GT(kernel.order(), 4);
  const std::array<double, 5> expected = {1, 2.0 / 3, 0.25, 0, -1.0 / 24};
  for (size_t l = 0; l < expected.size(); ++l) EXPECT_NEAR(kernel.factor[l], expected[l], 1e-13);
}

TEST(ZonalKernel, AddsUpToTheLobe) {
  for (const double alpha : {0.02, 0.1, 0.5}) {
    const ZonalKernel kernel = expand_lobe({.alpha = alpha}, 1e-6, 1800);
    for (const double c : {1.0, 0.999, 0.9, 0.4, -0.5}) {
      double sum = 0, previous = 0, current = 1;
      for (int l = 0; l <= kernel.order(); ++l) {
        sum += (2 * l + 1) / (4 * pi) * kernel.factor[static_cast<size_t>(l)] * current;
        const double next = ((2 * l + 1) * c * current - l * previous) / (l + 1);
        previous = current;
        current = next;
      }
      const Ggx<double> ggx = Ggx<double>::isotropic(alpha);
      EXPECT_NEAR(sum * kernel.integral, lobe_at(ggx, (1 - c) / 2), 3e-4 * lobe_at(ggx, 0.0))
          << alpha << " " << c;
    }
  }
}

TEST(FilterLobe, OfGgxIsThatOfItsDensityOfNormals) {
  for (const double alpha : {0.004, 0.1, 1.0}) {
    const Ggx<double> ggx = Ggx<double>::isotropic(alpha);
    for (const double s : {0.0, 1e-5, 0.01, 0.3, 0.49, 0.6}) {
      const double expected = ggx.D({std::sqrt(s), 0, std::sqrt(1 - s)}) * std::max(0.0, 1 - 2 * s);
      EXPECT_NEAR(lobe_at(ggx, s), expected, 1e-13 * expected);
    }
  }
}

TEST(LegendreColumn, IsOrthonormalOnTheSphere) {
  const RingPairs rings(2000);
  for (const int m : {0, 1, 7, 40}) {
    const LegendreColumn column(m, 60);
    WideDouble norm(0.0);
    for (int block = 0; block < rings.blocks(); ++block) {
      const WideDouble sine = rings.sine[static_cast<size_t>(block)];
      const WideDouble cosine = rings.cosine[static_cast<size_t>(block)];
      WideDouble p = column.seed(sine), before(0.0);
      for (size_t i = 1; i < column.scale.size(); ++i) {
        const WideDouble next = column.next(i, cosine, p, before);
        before = p;
        p = next;
      }
      norm += p * p * sine;
    }
    EXPECT_NEAR(4 * pi * xsimd::hadd(norm) * pi / rings.rings, 1, 1e-4) << m;
  }
}

TEST(HarmonicAnalysis, FindsTheHarmonicsOfPointMasses) {
  // A single texel: a_lm = L conj(Y_lm) dw, whose squares add up to (2l + 1)/(4 pi) per band.
  for (const Size size : {Size{64, 32}, Size{50, 27}}) {
    Layers image = make_layers(size, {"R", "G", "B"});
    const int x = 11, y = size.height / 2;
    const auto solid_angle = static_cast<float>(latlong_texel_solid_angle(size, y));
    for (size_t c = 0; c < 3; ++c) image.layers[c].plane.at(x, y) = static_cast<float>(c + 1);
    const Expansion found =
        analyse(color_planes(image), Across::Nothing, {{1e3, 1e3, 1e3}}, legendre_columns(20));
    for (int l = 0; l <= 20; ++l) {
      for (size_t c = 0; c < 3; ++c) {
        double sum = 0;
        for (int m = 0; m <= l; ++m) {
          const ColorCoefficient& a =
              found.columns[static_cast<size_t>(m)][static_cast<size_t>(l - m)];
          sum += (m == 0 ? 1 : 2) * (square(a[2 * c]) + square(a[2 * c + 1]));
        }
        const double power = static_cast<double>(c + 1) * solid_angle;
        EXPECT_NEAR(sum, square(power) * (2 * l + 1) / (4 * pi), 1e-7 * square(power) * (2 * l + 1))
            << l;
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
  std::vector<std::array<float, 4>> found(directions.size());
  field.evaluate(directions, found);
  for (size_t i = 0; i < directions.size(); ++i) {
    const auto expected = smooth(directions[i]);
    for (size_t c = 0; c < 4; ++c) EXPECT_NEAR(found[i][c], expected[c], 3e-6);
  }
}

}  // namespace
}  // namespace kiln
