// SPDX-License-Identifier: Apache-2.0
// Microfacet normals fall as their densities say, for every distribution at the corners of its
// parameters: chi-squared over cells of stretched slopes, which fit a lobe of any width; seeds
// 0..n-1, family-wise significance 0.01.
#include <gtest/gtest.h>

#include <functional>
#include <random>

#include "kiln/brdf/models.h"
#include "kiln/brdf/surface.h"
#include "kiln/integrate/gauss_legendre.h"
#include "support/chi_squared.h"
#include "support/directions.h"

namespace kiln {
namespace {

constexpr int samples = 400000;
constexpr int rows = 48, columns = 31;

// Cells of slopes stretched by the widths, t = sinh x: rows of x, columns of azimuth.
struct SlopeCells {
  double width_x, width_y, reach;

  Vec3<double> normal(double x, double phi) const {
    const double t = std::sinh(x);
    return normal_of_slopes(width_x * t * std::cos(phi), width_y * t * std::sin(phi));
  }
  size_t cell_of(const Vec3<double>& wm) const {
    const double sx = wm.x / wm.z / width_x, sy = wm.y / wm.z / width_y;
    const double x = std::asinh(std::sqrt(sx * sx + sy * sy));
    const int row = std::min(static_cast<int>(x / reach * rows), rows - 1);
    const double turn = std::atan2(sy, sx) / (2 * pi) + 0.5;
    const int column = std::min(static_cast<int>(turn * columns), columns - 1);
    return static_cast<size_t>(row * columns + column);
  }
  // Solid angle of normals per unit of x and phi.
  double solid_angle(const Vec3<double>& wm, double x) const {
    return width_x * width_y * wm.z * wm.z * wm.z * std::sinh(x) * std::cosh(x);
  }
};

SlopeCells cells_of(double width_x, double width_y) {
  return {width_x, width_y, std::asinh(100 / std::min(width_x, width_y))};
}

using Density = std::function<double(const Vec3<double>&)>;  // of normals [1/sr]
using Limit = std::function<double(double)>;                 // greatest x at an azimuth

// The last row reaches to infinity.
double mass_of(const SlopeCells& cells, const Density& density, const Limit& limit, int row,
               double phi) {
  static const Rule rule = gauss_legendre(8);
  const double from = cells.reach * row / rows;
  const double to = row == rows - 1 ? cells.reach + 12 : cells.reach * (row + 1) / rows;
  const double end = std::min(to, limit(phi));
  const int panels = row == rows - 1 ? 6 : 1;
  double sum = 0;
  for (int panel = 0; panel < panels && end > from; ++panel) {
    for (size_t i = 0; i < rule.nodes.size(); ++i) {
      const double x = from + (end - from) * (panel + rule.nodes[i]) / panels;
      const Vec3<double> wm = cells.normal(x, phi);
      sum += rule.weights[i] * density(wm) * cells.solid_angle(wm, x);
    }
  }
  return sum * std::max(end - from, 0.0) / panels;
}

// Expected counts; one more cell for what the limit cuts off.
std::vector<double> expect(const SlopeCells& cells, const Density& density, const Limit& limit) {
  static const Rule rule = gauss_legendre(12);
  std::vector<double> expected(rows * columns + 1);
  double total = 0;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      double mass = 0;
      for (size_t j = 0; j < rule.nodes.size(); ++j) {
        const double phi = 2 * pi * ((column + rule.nodes[j]) / columns - 0.5);
        mass += rule.weights[j] * mass_of(cells, density, limit, row, phi) * 2 * pi / columns;
      }
      expected[static_cast<size_t>(row * columns + column)] = mass * samples;
      total += mass;
    }
  }
  EXPECT_LE(total, 1 + 1e-4);
  expected.back() = std::max(1 - total, 0.0) * samples;
  return expected;
}

/// A sampler returns a normal, or one with z <= 0 for a rejected sample.
template <class Sampler>
std::vector<double> count(const SlopeCells& cells, const Sampler& sample, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::vector<double> counts(rows * columns + 1);
  for (int i = 0; i < samples; ++i) {
    const double u = uniform(random), v = uniform(random);
    const Vec3<double> wm = sample(Vec2<double>{u, v});
    counts[wm.z > 0 ? cells.cell_of(wm) : rows * columns] += 1;
  }
  return counts;
}

struct Widths {
  double x, y;
};

struct Corner {
  std::string label;
  std::function<test::ChiSquared(std::uint64_t seed)> run;
};

template <class Model>
std::vector<double> corner_shapes() {
  if constexpr (requires { Model::default_shape; }) {
    const ModelParam& shape = Model::params.back();
    return {shape.min, Model::default_shape, shape.max};
  } else {
    return {0};
  }
}

// Every distribution at every corner of its parameters.
std::vector<Corner> distribution_corners() {
  std::vector<Corner> corners;
  Distributions::for_each([&]<template <class> class Model>() {
    using M = Model<double>;
    std::vector<Widths> widths = {{1e-3, 1e-3}, {0.01, 0.01}, {0.1, 0.1}, {0.5, 0.5}, {1, 1}};
    if (M::anisotropic) widths.push_back({0.05, 0.8});
    for (const double shape : corner_shapes<M>()) {
      for (const Widths& w : widths) {
        const M model = make_distribution<M>(w.x, w.y, shape);
        const SlopeCells cells = M::alpha_is_width ? cells_of(w.x, w.y) : cells_of(1, 1);
        corners.push_back(
            {std::string(M::name) + " " + std::to_string(w.x) + " " + std::to_string(w.y) +
                 " shape " + std::to_string(shape),
             [model, cells](std::uint64_t seed) {
               const auto sample = [&](const Vec2<double>& u) { return model.sample(u); };
               return test::chi_squared(
                   count(cells, sample, seed),
                   expect(
                       cells, [&](const Vec3<double>& wm) { return model.D(wm) * wm.z; },
                       [](double) { return 1e9; }));
             }});
      }
    }
  });
  return corners;
}

TEST(EveryDistribution, IsSampledAsItsDensitySays) {
  const std::vector<Corner> corners = distribution_corners();
  std::uint64_t seed = 0;
  for (const Corner& corner : corners) {
    const test::ChiSquared result = corner.run(seed++);
    EXPECT_GT(result.cells, 20) << corner.label;
    EXPECT_GT(result.p, test::family_significance(static_cast<int>(corners.size())))
        << corner.label << " seed " << seed - 1;
  }
}

struct View {
  Widths widths;
  double mu, phi;
};

std::vector<View> views() {
  std::vector<View> list;
  for (const double alpha : {0.01, 0.1, 0.5, 1.0}) {
    for (const double mu : {1.0, 0.6, 0.05}) list.push_back({{alpha, alpha}, mu, 0.7});
  }
  for (const double phi : {0.0, 0.7, pi / 2}) {
    for (const double mu : {0.6, 0.05}) list.push_back({{0.05, 0.8}, mu, phi});
  }
  list.push_back({{0.05, 0.8}, 1, 0});
  return list;
}

Vec3<double> mirrored(const Vec3<double>& wo, const Vec3<double>& wm) {
  return wm * (2 * dot(wo, wm)) - wo;
}

// The greatest x whose mirror direction is above the horizon: with normals (ax t cos, ay t sin, 1),
// mu s^2 t^2 - 2 h t - mu < 0, hence t < mu / (sqrt(h^2 + mu^2 s^2) - h).
double horizon(const Ggx<double>& ggx, const Vec3<double>& wo, double phi) {
  const double x = ggx.alpha_x * std::cos(phi), y = ggx.alpha_y * std::sin(phi);
  const double h = wo.x * x + wo.y * y, s2 = x * x + y * y;
  const double root = std::sqrt(h * h + square(wo.z) * s2);
  return std::asinh(h > 0 ? (h + root) / (wo.z * s2) : wo.z / (root - h));
}

// Density of the normals: that of the mirrored directions times 4 wo.wm.
double normal_density(const Ggx<double>& ggx, const Vec3<double>& wo, const Vec3<double>& wm) {
  return ggx.visible_density(wo, ggx.D(wm)) * 4 * std::max(dot(wo, wm), 0.0);
}

TEST(BoundedVisibleNormals, FallAsTheirDensitySaysFromEverywhere) {
  std::uint64_t seed = 0;
  for (const View& view : views()) {
    const Ggx<double> ggx{view.widths.x, view.widths.y};
    const Vec3<double> wo = test::direction(view.mu, view.phi);
    const SlopeCells cells = cells_of(view.widths.x, view.widths.y);
    const auto sample = [&](const Vec2<double>& u) {
      const Vec3<double> wm = ggx.sample_visible(wo, u);
      return mirrored(wo, wm).z > 0 ? wm : Vec3<double>{0, 0, -1};
    };
    const auto result = test::chi_squared(
        count(cells, sample, seed++),
        expect(
            cells, [&](const Vec3<double>& wm) { return normal_density(ggx, wo, wm); },
            [&](double phi) { return horizon(ggx, wo, phi); }));
    EXPECT_GT(result.cells, 20);
    EXPECT_GT(result.p, test::family_significance(static_cast<int>(views().size())))
        << "alpha " << view.widths.x << " " << view.widths.y << " mu " << view.mu << " phi "
        << view.phi << " seed " << seed - 1;
  }
}

// The share of the unit square whose mirror direction is below the horizon, on a grid whose columns
// are shifted against each other.
double rejected_share(const Ggx<double>& ggx, const Vec3<double>& wo) {
  constexpr int across = 400, along = 2000;
  constexpr double golden = 0.6180339887498949;
  int rejected = 0;
  for (int j = 0; j < across; ++j) {
    const double u = (j + 0.5) / across, shift = j * golden - std::floor(j * golden);
    for (int i = 0; i < along; ++i) {
      rejected += mirrored(wo, ggx.sample_visible(wo, {u, (i + shift) / along})).z <= 0;
    }
  }
  return rejected / (1.0 * across * along);
}

TEST(BoundedVisibleNormals, HaveADensityOfOneMinusWhatIsRejected) {
  for (const View& view : views()) {
    const Ggx<double> ggx{view.widths.x, view.widths.y};
    const Vec3<double> wo = test::direction(view.mu, view.phi);
    const SlopeCells cells = cells_of(view.widths.x, view.widths.y);
    constexpr int azimuths = 1000;
    double mass = 0;
    for (int j = 0; j < azimuths; ++j) {
      const double phi = 2 * pi * (j + 0.5) / azimuths;
      for (int row = 0; row < rows; ++row) {
        mass += mass_of(
            cells, [&](const Vec3<double>& wm) { return normal_density(ggx, wo, wm); },
            [&](double p) { return horizon(ggx, wo, p); }, row, phi);
      }
    }
    mass *= 2 * pi / azimuths;
    EXPECT_NEAR(mass, 1 - rejected_share(ggx, wo), 1e-4)
        << "alpha " << view.widths.x << " " << view.widths.y << " mu " << view.mu << " phi "
        << view.phi;
  }
}

}  // namespace
}  // namespace kiln
