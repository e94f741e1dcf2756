// SPDX-License-Identifier: Apache-2.0
// The models of masking and of multiple scattering against random walks on the microsurface.
#include <gtest/gtest.h>

#include "kiln/brdf/energy.h"
#include "kiln/table/directional_albedo.h"
#include "support/directions.h"
#include "support/microsurface_walk.h"
#include "support/real_data.h"
#include "support/reference_values.h"

namespace kiln {
namespace {

constexpr int paths = 200000;

struct Tally {
  double once = 0;                      ///< share that left after one bounce
  double mean = 0, standard_error = 0;  ///< of the weight of all
  int most_bounces = 0;
};

template <class Model>
Tally tally(const Model& model, double mu, double f0, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const Vec3<double> wo = test::direction(mu, 0.3);
  double once = 0, sum = 0, squares = 0;
  Tally t;
  for (int i = 0; i < paths; ++i) {
    const auto walk = test::walk_microsurface(model, wo, Schlick<double>{f0, 1}, random);
    once += walk.bounces == 1;
    sum += walk.weight;
    squares += walk.weight * walk.weight;
    t.most_bounces = std::max(t.most_bounces, walk.bounces);
  }
  t.once = once / paths;
  t.mean = sum / paths;
  t.standard_error = std::sqrt(std::max(squares / paths - t.mean * t.mean, 0.0) / paths);
  return t;
}

// E of the reference values for some widths and directions, against the share of one bounce.
template <template <class> class Model>
int check_single_bounce(const std::filesystem::path& table, const std::string& name) {
  int checked = 0;
  for (const auto& v : test::read_reference_values(table)) {
    if (v.model != name || v.quantity != "E") continue;
    const double mu = std::stod(v.mu), roughness = std::stod(v.roughness);
    const bool wanted = (mu == 0.1 || mu == 0.5 || mu == 1) &&
                        (roughness == 0.35 || roughness == 0.7 || roughness == 1);
    if (!wanted) continue;
    const auto model = Model<double>::isotropic(std::stod(v.alpha));
    const Tally t = tally(model, mu, 1, static_cast<std::uint64_t>(checked));
    const double sigma = std::sqrt(v.value * (1 - v.value) / paths);
    EXPECT_NEAR(t.once, v.value, 4 * sigma) << name << " mu " << mu << " roughness " << roughness;
    ++checked;
  }
  return checked;
}

TEST(MicrosurfaceWalk, LeavesAfterOneBounceAsOftenAsSmithSays) {
  KILN_REQUIRE_REAL_DATA(folder);
  const auto table = folder / "reference/reference_values.csv";
  EXPECT_EQ(check_single_bounce<Ggx>(table, "ggx_smith_heightcorr"), 9);
  EXPECT_EQ(check_single_bounce<Beckmann>(table, "beckmann_smith_heightcorr"), 9);
}

TEST(MicrosurfaceWalk, LeavesAfterOneBounceAsOftenAsTheIntegralSays) {
  const double alpha = 0.6, mu = 0.4, e = integrate_split_sum(mu, alpha, Quality::Exact).total();
  const Tally t = tally(Ggx<double>::isotropic(alpha), mu, 1, 0);
  EXPECT_NEAR(t.once, e, 4 * std::sqrt(e * (1 - e) / paths));
}

TEST(MicrosurfaceWalk, OfAWhiteSurfaceLosesNothing) {
  for (const double alpha : {0.1, 1.0}) {
    for (const double mu : {0.05, 1.0}) {
      const Tally ggx = tally(Ggx<double>::isotropic(alpha), mu, 1, 0);
      const Tally beckmann = tally(Beckmann<double>::isotropic(alpha), mu, 1, 1);
      EXPECT_EQ(ggx.mean, 1);
      EXPECT_EQ(beckmann.mean, 1);
      EXPECT_LT(std::max(ggx.most_bounces, beckmann.most_bounces), 1000);  // all have left
    }
  }
}

// Errors of albedo of the models, and the albedo of the walk, as known.
struct KnownErrors {
  double alpha, mu, f0, truth, kulla_conty, turquin, fdez_aguera;
};
constexpr KnownErrors known_errors[] = {{0.25, 0.5, 0.5, 0.4849, -0.008, -0.009, -0.010},
                                        {0.5, 0.5, 0.5, 0.4355, -0.013, -0.005, -0.015},
                                        {0.5, 1, 0.9, 0.8682, -0.004, 0.004, -0.006},
                                        {1, 0.1, 0.5, 0.4557, -0.025, -0.002, -0.007},
                                        {1, 0.5, 0.9, 0.8336, -0.032, 0.018, -0.027},
                                        {1, 1, 0.5, 0.2827, -0.017, 0.044, -0.042},
                                        {1, 1, 0.04, 0.0139, 0.001, -0.001, -0.001}};

TEST(EnergyModels, ErrAgainstTheWalkByWhatIsKnown) {
  std::uint64_t seed = 0;
  for (const KnownErrors& known : known_errors) {
    const auto at = integrate_split_sum(known.mu, known.alpha, Quality::Exact);
    const Albedo<double> albedo{at, at, integrate_average(known.alpha)};
    const ChannelEnergy<double> channel{known.f0, known.f0 + (1 - known.f0) / 21,
                                        known.f0 * at.scale + at.bias};
    const Tally walk = tally(Ggx<double>::isotropic(known.alpha), known.mu, known.f0, seed++);
    // The known numbers are rounded and of a walk too.
    const double tolerance = 4 * walk.standard_error + 1.5e-3;
    const auto error = [&]<template <class> class Model>() {
      const double e = Model<double>::total(channel, albedo) - walk.mean;
      RecordProperty(std::string(Model<double>::name) + "." + std::to_string(seed - 1),
                     std::to_string(e));
      return e;
    };
    const std::string label = "alpha " + std::to_string(known.alpha) + " mu " +
                              std::to_string(known.mu) + " F0 " + std::to_string(known.f0);
    EXPECT_NEAR(walk.mean, known.truth, tolerance) << label;
    EXPECT_NEAR(error.template operator()<KullaConty>(), known.kulla_conty, tolerance) << label;
    EXPECT_NEAR(error.template operator()<Turquin>(), known.turquin, tolerance) << label;
    EXPECT_NEAR(error.template operator()<FdezAguera>(), known.fdez_aguera, tolerance) << label;
  }
}

}  // namespace
}  // namespace kiln
