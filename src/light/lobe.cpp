// SPDX-License-Identifier: Apache-2.0
#include "lobe.h"

#include "kiln/brdf/models.h"
#include "kiln/core/error.h"

namespace kiln {
namespace {

/// Calls visit(distribution) with what lobe_at takes for that lobe.
template <class F, class Visit>
void with_lobe(const FilterLobe& lobe, Visit&& visit) {
  const F alpha = F(static_cast<ScalarOf<F>>(lobe.alpha));
  if (lobe.masked) return visit(MaskedGgx<F>{alpha * alpha});
  bool found = false;
  Distributions::for_each([&]<template <class> class Distribution>() {
    if (Distribution<double>::name != kebab(lobe.distribution)) return;
    found = true;
    visit(make_distribution<Distribution<F>>(alpha, alpha, lobe.shape));
  });
  if (!found) {
    throw Error(Fault::Usage,
                unknown_name("distribution", lobe.distribution, model_names("distribution")));
  }
}

float rest_of(double value) {
  return static_cast<float>(value - static_cast<double>(static_cast<float>(value)));
}

template <class Distribution>
MassSums sum_masses(const Distribution& distribution, const PointMasses& masses,
                    const Vec3<double>& d) {
  constexpr size_t lanes = lane_count<WideFloat>;
  const std::array<double, 3> toward{d.x, d.y, d.z};
  std::array<WideFloat, 3> coordinate, rest;
  for (size_t a = 0; a < 3; ++a) {
    coordinate[a] = WideFloat(static_cast<float>(toward[a]));
    rest[a] = WideFloat(rest_of(toward[a]));
  }
  std::array<WideFloat, 4> sums;
  sums.fill(WideFloat(0.0f));
  for (size_t i = 0; i < masses.size(); i += lanes) {
    WideFloat squares(0.0f);
    for (size_t a = 0; a < 3; ++a) {
      const WideFloat apart =
          (coordinate[a] - load_lanes<WideFloat>(masses.direction[a].data() + i)) +
          (rest[a] - load_lanes<WideFloat>(masses.rest[a].data() + i));
      squares = fma(apart, apart, squares);
    }
    const WideFloat lobe = lobe_at(distribution, WideFloat(0.25f) * squares);
    for (size_t c = 0; c < 4; ++c) {
      sums[c] = fma(lobe, load_lanes<WideFloat>(masses.power[c].data() + i), sums[c]);
    }
  }
  return {xsimd::hadd(sums[0]), xsimd::hadd(sums[1]), xsimd::hadd(sums[2]), xsimd::hadd(sums[3])};
}

}  // namespace

std::vector<double> lobe_values(const FilterLobe& lobe, std::span<const double> s) {
  std::vector<double> values;
  values.reserve(s.size());
  with_lobe<double>(lobe, [&](const auto& distribution) {
    for (const double one : s) values.push_back(lobe_at(distribution, one));
  });
  return values;
}

void PointMasses::reset(size_t count) {
  constexpr size_t lanes = lane_count<WideFloat>;
  const size_t padded = (count + lanes - 1) / lanes * lanes;
  for (auto* family : {&direction, &rest}) {
    for (std::vector<float>& numbers : *family) numbers.assign(padded, 0.0f);
  }
  for (std::vector<float>& numbers : power) numbers.assign(padded, 0.0f);
}

void PointMasses::set(size_t at, const Vec3<double>& toward, const std::array<double, 4>& of) {
  const std::array<double, 3> coordinates{toward.x, toward.y, toward.z};
  for (size_t a = 0; a < 3; ++a) {
    direction[a][at] = static_cast<float>(coordinates[a]);
    rest[a][at] = rest_of(coordinates[a]);
  }
  for (size_t c = 0; c < 4; ++c) power[c][at] = static_cast<float>(of[c]);
}

void add_masses(const FilterLobe& lobe, const PointMasses& masses,
                std::span<const Vec3<double>> directions, std::span<MassSums> sums) {
  if (masses.size() == 0) return;
  with_lobe<WideFloat>(lobe, [&](const auto& distribution) {
    for (size_t i = 0; i < directions.size(); ++i) {
      const MassSums found = sum_masses(distribution, masses, directions[i]);
      for (size_t c = 0; c < 4; ++c) sums[i][c] += found[c];
    }
  });
}

}  // namespace kiln
