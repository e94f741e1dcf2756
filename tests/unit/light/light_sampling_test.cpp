// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "kiln/light/environment.h"
#include "kiln/light/irradiance.h"
#include "kiln/parallel/rows.h"
#include "synthetic.h"

namespace kiln {
namespace {

using test::random_unit;

constexpr double significance = 0.01;

/// Significance of one of `cases` tests, such that all together keep theirs (Sidak).
double each_of(int cases) { return 1 - std::pow(1 - significance, 1.0 / cases); }

/// Probability of a chi-squared above `statistic`. @source Wilson and Hilferty 1931
double chi_squared_tail(double statistic, double degrees) {
  const double variance = 2 / (9 * degrees);
  const double z = (std::cbrt(statistic / degrees) - (1 - variance)) / std::sqrt(variance);
  return 0.5 * std::erfc(z / std::sqrt(2.0));
}

Layers node_aligned_glow(Size size) {
  Layers image = make_layers(size, {"R", "G", "B"});
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const Vec3<double> d =
          latlong_to_direction(Vec2<double>{x / (size.width - 1.0), y / (size.height - 1.0)});
      for (Layer& layer : image.layers) {
        layer.plane.at(x, y) = static_cast<float>(std::exp(4 * (d.x + d.y)));
      }
    }
  }
  return image;
}

struct Case {
  Layers image;
  bool node_aligned;
  double rotate_deg;
};

std::vector<Case> cases() {
  std::vector<Case> all;
  all.push_back({test::sunny_environment({128, 64}, 1), false, 0});
  all.push_back({test::sunny_environment({128, 64}, 1e3), false, 45});
  all.push_back({test::sunny_environment({128, 64}, 1e6), false, -90});
  all.push_back({test::sunny_environment({192, 96}, 50), false, 0});
  all.push_back({test::constant_environment({64, 32}, 0), false, 0});
  all.push_back({node_aligned_glow({129, 65}), true, 90});
  return all;
}

constexpr Size grid{64, 32};

/// Probability of each cell of the grid, from the density at the environment's own cells.
std::vector<double> expected_shares(const Environment& environment) {
  const Size cells = environment.cells();
  std::vector<double> shares(static_cast<size_t>(area(grid)));
  for (int y = 0; y < cells.height; ++y) {
    for (int x = 0; x < cells.width; ++x) {
      const Vec3<double> d = test::texel_direction(cells, x, y);
      const Vec2<double> uv = direction_to_latlong(d);
      const auto cell = static_cast<size_t>(static_cast<int>(uv.y * grid.height) * grid.width +
                                            static_cast<int>(uv.x * grid.width));
      shares[cell] += environment.density(d) * latlong_texel_solid_angle(cells, y);
    }
  }
  return shares;
}

template <class F>
void add_samples(const Environment& environment, std::uint32_t seed, int count,
                 std::vector<double>& counts) {
  constexpr int lanes = lane_count<F>;
  for (int first = 0; first < count; first += lanes) {
    ScalarOf<F> a[lanes], b[lanes], x[lanes], y[lanes], z[lanes];
    for (int i = 0; i < lanes; ++i) {
      const auto index = static_cast<std::uint32_t>(first + i);
      a[i] = static_cast<ScalarOf<F>>(std::floor(random_unit(seed, 2 * index) * 0x1p24) * 0x1p-24);
      b[i] =
          static_cast<ScalarOf<F>>(std::floor(random_unit(seed, 2 * index + 1) * 0x1p24) * 0x1p-24);
    }
    const auto sample = environment.sample(Vec2<F>{load_lanes<F>(a), load_lanes<F>(b)});
    store_lanes(x, sample.direction.x);
    store_lanes(y, sample.direction.y);
    store_lanes(z, sample.direction.z);
    for (int i = 0; i < lanes; ++i) {
      const Vec2<double> uv = direction_to_latlong(Vec3<double>{x[i], y[i], z[i]});
      const int column = std::min(grid.width - 1, static_cast<int>(uv.x * grid.width));
      const int row = std::min(grid.height - 1, static_cast<int>(uv.y * grid.height));
      ++counts[static_cast<size_t>(row * grid.width + column)];
    }
  }
}

/// Chi-squared test; cells that expect fewer than 5 are taken together.
double chi_squared_p(const std::vector<double>& shares, const std::vector<double>& counts,
                     double total) {
  double statistic = 0, rest_expected = 0, rest_found = 0;
  int cells = 0;
  for (size_t i = 0; i < shares.size(); ++i) {
    const double expected = shares[i] * total;
    if (expected < 5) {
      rest_expected += expected;
      rest_found += counts[i];
      continue;
    }
    statistic += square(counts[i] - expected) / expected;
    ++cells;
  }
  if (rest_expected >= 5) {
    statistic += square(rest_found - rest_expected) / rest_expected;
    ++cells;
  }
  return chi_squared_tail(statistic, cells - 1);
}

TEST(EnvironmentSampling, DrawsDirectionsByTheDensityItStates) {
  const std::vector<Case> all = cases();
  constexpr int count = 1 << 20;
  const double threshold = each_of(2 * static_cast<int>(all.size()));
  for (size_t i = 0; i < all.size(); ++i) {
    const Environment environment(all[i].image, {all[i].node_aligned, all[i].rotate_deg});
    const std::vector<double> shares = expected_shares(environment);
    std::vector<double> scalar(shares.size()), wide(shares.size());
    add_samples<float>(environment, static_cast<std::uint32_t>(2 * i), count, scalar);
    add_samples<WideFloat>(environment, static_cast<std::uint32_t>(2 * i + 1), count, wide);
    EXPECT_GT(chi_squared_p(shares, scalar, count), threshold) << "case " << i << ", float";
    EXPECT_GT(chi_squared_p(shares, wide, count), threshold) << "case " << i << ", wide";
  }
}

struct Estimate {
  double mean, standard_error;
};

// Irradiance over pi along n, by directions drawn by importance.
Estimate estimate_irradiance(const Environment& environment, const Vec3<double>& n,
                             std::uint32_t seed, int count) {
  double sum = 0, squares = 0;
  for (int i = 0; i < count; ++i) {
    const auto index = static_cast<std::uint32_t>(i);
    const LightSample<double> sample = environment.sample(
        Vec2<double>{random_unit(seed, 2 * index), random_unit(seed, 2 * index + 1)});
    const double value =
        sample.radiance.y * std::max(0.0, dot(sample.direction, n)) / (pi * sample.density);
    sum += value;
    squares += value * value;
  }
  const double mean = sum / count;
  return {mean, std::sqrt(std::max(0.0, squares / count - mean * mean) / (count - 1))};
}

TEST(EnvironmentSampling, EstimatesIrradiance) {
  const Layers image = test::sunny_environment({128, 64}, 1e3);
  const Environment environment(image);
  constexpr int normals = 12;
  std::array<Estimate, normals> estimates;
  for_rows(normals, [&](int i) {
    const auto seed = static_cast<std::uint32_t>(i);
    estimates[seed] =
        estimate_irradiance(environment, test::random_direction(0, seed), seed, 1 << 17);
  });
  // The map knows texels as points, the estimate reads them bilinearly: made finer they agree.
  Layers fine{{1024, 512}, {}};
  for (const char* name : {"R", "G", "B"}) fine.add(name);
  for (int y = 0; y < 512; ++y) {
    for (int x = 0; x < 1024; ++x) {
      fine.layers[1].plane.at(x, y) =
          static_cast<float>(environment.radiance(test::texel_direction(fine.size, x, y)).y);
    }
  }
  for (int i = 0; i < normals; ++i) {
    const Estimate& found = estimates[static_cast<size_t>(i)];
    const Vec3<double> n = test::random_direction(0, static_cast<std::uint32_t>(i));
    const double expected = irradiance_over_pi(fine, n).y;
    EXPECT_LT(std::abs(found.mean - expected), 4 * found.standard_error) << i;
    EXPECT_LT(found.standard_error, 0.02 * expected) << i;
  }
}

}  // namespace
}  // namespace kiln
