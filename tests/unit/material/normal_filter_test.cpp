// SPDX-License-Identifier: Apache-2.0
#include "kiln/material/normal_filter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "kiln/brdf/beckmann.h"
#include "kiln/image/mip_levels.h"
#include "kiln/math/frame.h"
#include "kiln/math/hash.h"

namespace kiln {
namespace {

using Normal = Vec3<double>;

struct Lobe {
  double roughness = 0, alpha_x = 0, alpha_y = 0, angle = 0;
};

// The one texel that a row of normals with these weights comes to.
Lobe filtered(const NormalFiltering& filtering, const std::vector<Normal>& normals,
              double roughness, const std::vector<double>& weights = {}) {
  const int count = moment_count(filtering.method);
  const Size size{static_cast<int>(normals.size()), 1};
  std::array<Plane, 3> n = {Plane(size), Plane(size), Plane(size)};
  const Plane rough(size, static_cast<float>(roughness));
  for (int i = 0; i < size.width; ++i) {
    n[0].at(i, 0) = static_cast<float>(normals[i].x);
    n[1].at(i, 0) = static_cast<float>(normals[i].y);
    n[2].at(i, 0) = static_cast<float>(normals[i].z);
  }
  std::vector<Plane> moments(count, Plane(size)), means(count, Plane({1, 1}));
  std::vector<float*> rows;
  for (Plane& plane : moments) rows.push_back(plane.row(0));
  fill_moments(filtering.method,
               {size.width, rough.row(0), {n[0].row(0), n[1].row(0), n[2].row(0)}}, rows.data());
  std::vector<const float*> mean_rows;
  for (int c = 0; c < count; ++c) {
    double sum = 0;
    for (int i = 0; i < size.width; ++i) {
      sum += moments[c].at(i, 0) * (weights.empty() ? 1.0 / size.width : weights[i]);
    }
    means[c].at(0, 0) = static_cast<float>(sum);
    mean_rows.push_back(means[c].row(0));
  }
  std::vector<Plane> made(4, Plane({1, 1}));
  lobes_of_moments(filtering, 1, mean_rows.data(),
                   {made[0].row(0), made[1].row(0), made[2].row(0), made[3].row(0)});
  return {made[0].at(0, 0), made[1].at(0, 0), made[2].at(0, 0), made[3].at(0, 0)};
}

// Density of slopes of Beckmann's distribution.
double slope_density(double alpha_x, double alpha_y, double x, double y) {
  const Normal normal = normal_of_slopes(x, y);
  return Beckmann<double>::make(alpha_x, alpha_y, 0).D(normal) * square(square(normal.z));
}

double alpha_squared(const Lobe& lobe) { return std::pow(lobe.roughness, 4); }

// Normals of a cone of half-angle `angle` about an axis.
std::vector<Normal> cone(double angle, const Normal& axis) {
  const Frame<double> frame = frame_around(axis);
  std::vector<Normal> normals;
  for (int i = 0; i < 64; ++i) {
    const double phi = 2 * pi * (i + 0.5) / 64;
    normals.push_back(frame.to_world(
        {std::sin(angle) * std::cos(phi), std::sin(angle) * std::sin(phi), std::cos(angle)}));
  }
  return normals;
}

constexpr NormalFilter all_methods[] = {NormalFilter::None, NormalFilter::Toksvig,
                                        NormalFilter::Vmf, NormalFilter::Lean};

TEST(NormalFilter, ChangesNothingWhereNormalsAreFlat) {
  const std::vector<Normal> flat(7, Normal{0, 0, 1});
  for (const NormalFilter method : all_methods) {
    for (const double roughness : {0.0, 0.02, 0.3, 1.0}) {
      const Lobe lobe = filtered({.method = method}, flat, roughness);
      EXPECT_NEAR(lobe.roughness, roughness, 2e-7);
      EXPECT_NEAR(lobe.alpha_x, roughness * roughness, 2e-7);
      EXPECT_NEAR(lobe.alpha_y, roughness * roughness, 2e-7);
    }
  }
}

TEST(NormalFilter, ChangesLittleWhereNormalsAreTiltedAlike) {
  const std::vector<Normal> tilted(7, normalize(Normal{0.5, -0.3, 1}));
  for (const NormalFilter method : all_methods) {
    EXPECT_NEAR(filtered({.method = method}, tilted, 0.3).roughness, 0.3, 2e-5);
  }
}

// Beckmann's density of slopes is Gaussian of the variance alpha^2 / 2, and Gaussians convolve to
// one whose variance is the sum.
TEST(NormalFilter, LeanIsExactForBeckmannAndGaussianSlopes) {
  const double alpha = 0.25, deviation_x = 0.2, deviation_y = 0.1;
  std::vector<Normal> normals;
  std::vector<double> weights;
  double all = 0;
  constexpr int n = 41;
  for (int i = 0; i < n * n; ++i) {
    const double x = 10.0 * (i % n - n / 2) / n, y = 10.0 * (i / n - n / 2) / n;
    normals.push_back(normal_of_slopes(deviation_x * x, deviation_y * y));
    weights.push_back(std::exp(-0.5 * (x * x + y * y)));
    all += weights.back();
  }
  for (double& weight : weights) weight /= all;
  const Lobe lobe = filtered({.method = NormalFilter::Lean}, normals, std::sqrt(alpha), weights);
  EXPECT_NEAR(square(lobe.alpha_x), square(alpha) + 2 * square(deviation_x), 1e-4);
  EXPECT_NEAR(square(lobe.alpha_y), square(alpha) + 2 * square(deviation_y), 1e-4);
  EXPECT_NEAR(alpha_squared(lobe), 0.5 * (square(lobe.alpha_x) + square(lobe.alpha_y)), 1e-5);
  EXPECT_NEAR(std::min(lobe.angle, 1 - lobe.angle), 0, 1e-4);
  for (const Vec2<double> slope : {Vec2<double>{0, 0}, {0.3, 0}, {0.1, 0.4}, {-0.5, 0.2}}) {
    double average = 0;
    for (size_t i = 0; i < normals.size(); ++i) {
      const double x = slope.x - normals[i].x / normals[i].z;
      const double y = slope.y - normals[i].y / normals[i].z;
      average += weights[i] * slope_density(alpha, alpha, x, y);
    }
    const double one = slope_density(lobe.alpha_x, lobe.alpha_y, slope.x, slope.y);
    EXPECT_NEAR(one, average, 2e-3 * average);
  }
}

TEST(NormalFilter, LeanFindsTheDirectionOfCorrugations) {
  for (const double half_turns : {0.0, 0.1, 0.4, 0.75}) {
    std::vector<Normal> normals;
    for (const double slope : {-0.2, -0.1, 0.1, 0.2}) {
      normals.push_back(
          normal_of_slopes(slope * std::cos(pi * half_turns), slope * std::sin(pi * half_turns)));
    }
    const Lobe lobe = filtered({.method = NormalFilter::Lean}, normals, 0.3);
    EXPECT_NEAR(lobe.alpha_y, 0.09, 1e-5);
    EXPECT_NEAR(square(lobe.alpha_x), square(0.09) + 2 * 0.025, 1e-5);
    EXPECT_NEAR(std::remainder(lobe.angle - half_turns, 1.0), 0, 1e-5);
  }
}

TEST(NormalFilter, DoesNotMindHowTheWholeFootprintIsTilted) {
  const double angle = 0.06;
  for (const NormalFilter method : {NormalFilter::Toksvig, NormalFilter::Vmf, NormalFilter::Lean}) {
    const Lobe level = filtered({.method = method}, cone(angle, {0, 0, 1}), 0.2);
    const Lobe tilted =
        filtered({.method = method}, cone(angle, normalize(Normal{0.6, -0.4, 1})), 0.2);
    EXPECT_GT(alpha_squared(level), square(0.04) + 0.8 * square(angle));
    EXPECT_NEAR(alpha_squared(tilted), alpha_squared(level), 0.02 * square(angle));
    EXPECT_NEAR(tilted.alpha_y, tilted.alpha_x, 0.02 * tilted.alpha_x + 1e-6);
  }
}

TEST(NormalFilter, VmfRecoversTheConcentrationOfAVonMisesFisherDistribution) {
  for (const double k : {20.0, 100.0, 1000.0}) {
    // Cosines with the density exp(k z), by inverting its cumulative distribution.
    std::vector<Normal> normals;
    constexpr int rings = 400, around = 8;
    for (int i = 0; i < rings * around; ++i) {
      const double u = (i / around + 0.5) / rings, phi = 2 * pi * (i % around) / around;
      const double z = 1 + std::log(u + (1 - u) * std::exp(-2 * k)) / k;
      const double s = std::sqrt(std::max(0.0, 1 - z * z));
      normals.push_back({s * std::cos(phi), s * std::sin(phi), z});
    }
    const Lobe lobe = filtered({.method = NormalFilter::Vmf}, normals, 0.3);
    EXPECT_NEAR(alpha_squared(lobe) - std::pow(0.3, 4), 2 / k, 0.01 / k);
  }
}

TEST(NormalFilter, ToksvigIsTheOneOfThePublishedExponents) {
  for (const double roughness : {0.1, 0.4, 0.9}) {
    for (const double angle : {0.1, 0.5, 1.0}) {
      const double n = std::cos(angle), a = roughness * roughness, s = 2 / (a * a) - 2;
      const double expected = 2 / (s * n / (n + s * (1 - n)) + 2);
      const Lobe lobe =
          filtered({.method = NormalFilter::Toksvig}, cone(angle, {0, 0, 1}), roughness);
      EXPECT_NEAR(alpha_squared(lobe), expected, 1e-5);
    }
  }
}

TEST(NormalFilter, AddsWhatItIsAllowedTo) {
  const std::vector<Normal> normals = cone(0.3, {0, 0, 1});
  for (const NormalFilter method : {NormalFilter::Toksvig, NormalFilter::Vmf, NormalFilter::Lean}) {
    const double base = std::pow(0.4, 4);
    const double once = alpha_squared(filtered({.method = method}, normals, 0.4)) - base;
    const double twice =
        alpha_squared(filtered({.method = method, .strength = 2}, normals, 0.4)) - base;
    const double held =
        alpha_squared(filtered({.method = method, .most_added = 0.01}, normals, 0.4)) - base;
    EXPECT_NEAR(twice, 2 * once, 1e-5);
    EXPECT_NEAR(held, 0.01, 1e-5);
  }
}

TEST(NormalFilter, NeverLeavesTheRangeOfRoughness) {
  std::vector<Normal> wild;
  for (uint32_t i = 0; i < 64; ++i) {
    const double phi = 2 * pi * i / 64;
    const double z = combine_hash(7u, i) / 4294967296.0;
    wild.push_back(normalize(Normal{std::cos(phi), std::sin(phi), 0.01 + z}));
  }
  for (const NormalFilter method : all_methods) {
    const Lobe lobe = filtered({.method = method}, wild, 0.5);
    for (const double value : {lobe.roughness, lobe.alpha_x, lobe.alpha_y, lobe.angle}) {
      EXPECT_GE(value, 0);
      EXPECT_LE(value, 1);
    }
    EXPECT_GE(lobe.roughness, 0.5 - 1e-6);
  }
}

}  // namespace
}  // namespace kiln
