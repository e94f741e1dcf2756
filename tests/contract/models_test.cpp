// SPDX-License-Identifier: Apache-2.0
// Every model on the lists, at every number type. A new model is tested by being listed.
#include "kiln/brdf/models.h"

#include <gtest/gtest.h>

#include <set>

#include "kiln/integrate/gauss_legendre.h"
#include "support/agreement.h"
#include "support/directions.h"

namespace kiln {
namespace {

TEST(EveryModel, SaysWhatItIsAndWhereItIsFrom) {
  for (const ModelFacts& model : all_models()) {
    EXPECT_FALSE(model.name.empty());
    EXPECT_FALSE(model.summary.empty()) << model.name;
    EXPECT_FALSE(model.source.empty()) << model.name;
  }
}

TEST(EveryModel, DescribesParametersWithinTheirRanges) {
  for (const ModelFacts& model : all_models()) {
    for (const ModelParam& param : model.params) {
      EXPECT_FALSE(param.meaning.empty()) << model.name << " " << param.name;
      EXPECT_LT(param.min, param.max) << model.name << " " << param.name;
      EXPECT_TRUE(param.min <= param.initial && param.initial <= param.max)
          << model.name << " " << param.name;
    }
  }
}

TEST(EveryModel, HasANameOfItsOwnInItsFamily) {
  std::set<std::string> names;
  for (const ModelFacts& model : all_models()) {
    EXPECT_TRUE(names.insert(model.family + " " + model.name).second) << model.name;
  }
}

template <class Model>
Model gray(double color, double roughness) {
  using F = decltype(Model::roughness);
  const F c = F(ScalarOf<F>(color));
  return {{c, c, c}, F(ScalarOf<F>(roughness))};
}

TEST(EveryDiffuse, IsReciprocalAndNeverNegative) {
  Diffuses::for_each([]<template <class> class Model>() {
    EXPECT_TRUE(Model<double>::reciprocal);
    for (const double roughness : {0.0, 0.4, 1.0}) {
      const Model<double> model{{0.2, 0.5, 0.9}, roughness};
      for (const Vec3<double>& wo : test::hemisphere(20)) {
        for (const Vec3<double>& wi : test::hemisphere(17)) {
          const double there = model.eval(wo, wi).y, back = model.eval(wi, wo).y;
          EXPECT_GE(there, 0) << Model<double>::name;
          EXPECT_NEAR(there, back, 1e-12 * there) << Model<double>::name;
        }
      }
    }
  });
}

// With mu_i = x^2 what diverges toward the horizon is smooth.
template <class Model>
double integrated_albedo(const Model& model, double mu) {
  static const Rule rule = gauss_legendre(160);
  constexpr int azimuths = 1000;
  const Vec3<double> wo = test::direction(mu, 1);
  double sum = 0;
  for (size_t i = 0; i < rule.nodes.size(); ++i) {
    const double mu_i = square(rule.nodes[i]), dmu = 2 * rule.nodes[i] * rule.weights[i];
    for (int j = 0; j < azimuths; ++j) {
      const Vec3<double> wi = test::direction(mu_i, 1 + pi * (j + 0.5) / azimuths);
      sum += model.eval(wo, wi).y * mu_i * dmu;
    }
  }
  return sum * 2 * pi / azimuths;
}

// 2e-5 is what the quadrature here errs by where a model has kinks.
TEST(EveryDiffuse, ReflectsItsStatedAlbedo) {
  Diffuses::for_each([]<template <class> class Model>() {
    for (const double roughness : {0.0, 0.3, 1.0}) {
      for (const double mu : {1e-3, 0.05, 0.5, 0.9, 1.0}) {
        const Model<double> model{{0.3, 0.8, 1.0}, roughness};
        EXPECT_NEAR(integrated_albedo(model, mu), model.albedo(mu).y, 2e-5)
            << Model<double>::name << " roughness " << roughness << " mu " << mu;
      }
    }
  });
}

TEST(EveryDiffuse, ReflectsAtMostWhatItSays) {
  Diffuses::for_each([]<template <class> class Model>() {
    double greatest = 0;
    for (int r = 0; r <= 100; ++r) {
      for (int m = 0; m <= 100; ++m) {
        greatest = std::max(greatest, gray<Model<double>>(1, r / 100.0).albedo(m / 100.0).x);
      }
    }
    EXPECT_LE(greatest, Model<double>::greatest_albedo + 1e-12) << Model<double>::name;
    EXPECT_GE(greatest, Model<double>::greatest_albedo - 1e-3) << Model<double>::name;
  });
}

TEST(EveryDiffuse, AgreesAtEveryNumberType) {
  Diffuses::for_each([]<template <class> class Model>() {
    for (const double roughness : {0.0, 0.5, 1.0}) {
      const Model<double> oracle = gray<Model<double>>(0.75, roughness);
      for (const Vec3<double>& a : test::hemisphere(20)) {
        const Vec3<double> wo = test::rounded(a), wi = test::rounded(test::direction(0.6, 2));
        test::expect_alike(
            oracle.eval(wo, wi).y, 2e-6, 1e-3,
            [&]<class F>() {
              return gray<Model<F>>(0.75, roughness).eval(test::as<F>(wo), test::as<F>(wi)).y;
            },
            Model<double>::name);
        test::expect_alike(
            oracle.albedo(wo.z).y, 2e-6, 1e-3,
            [&]<class F>() {
              return gray<Model<F>>(0.75, roughness).albedo(F(ScalarOf<F>(wo.z))).y;
            },
            Model<double>::name);
      }
    }
  });
}

// Channels that try the corners of every parameter.
template <class F>
std::vector<FresnelChannel<F>> channels() {
  std::vector<FresnelChannel<F>> list;
  const auto f = [](double x) { return F(ScalarOf<F>(x)); };
  for (const double f0 : {0.0, 0.04, 0.5, 0.95, 1.0}) {
    for (const double f82 : {0.0, 0.6, 1.0}) {
      for (const double tint : {0.0, 0.5, 1.0}) {
        list.push_back({.f0 = f(f0), .f90 = f(1), .f82 = f(f82), .edge_tint = f(tint)});
      }
    }
  }
  for (const double n : {0.05, 0.2, 0.7, 1.0, 1.001, 1.1, 1.24, 1.26, 1.5, 2.4, 20.0}) {
    for (const double k : {0.0, 0.5, 3.9, 20.0}) {
      list.push_back({.ior = f(n), .extinction = f(k), .dip = f(0.5), .exponent = f(5.5)});
    }
  }
  return list;
}

TEST(EveryFresnel, LiesBetweenZeroAndOneAndAgreesAtEveryNumberType) {
  Fresnels::for_each([]<template <class> class Model>() {
    for (size_t k = 0; k < channels<double>().size(); ++k) {
      // The oracle takes the parameters as float has them.
      const FresnelChannel<float> c = channels<float>()[k];
      const Model<double> oracle = Model<double>::make(
          {c.f0, c.f90, c.f82, c.edge_tint, c.ior, c.extinction, c.dip, c.exponent});
      for (int i = 0; i <= 40; ++i) {
        const double cosine = static_cast<float>(i / 40.0);
        const double truth = oracle.eval(cosine);
        EXPECT_GE(truth, 0) << Model<double>::name;
        EXPECT_LE(truth, 1 + 1e-14) << Model<double>::name;
        const auto at = [&]<class F>() {
          const auto f = [](float x) { return F(ScalarOf<F>(x)); };
          const FresnelChannel<F> channel{f(c.f0),  f(c.f90),        f(c.f82), f(c.edge_tint),
                                          f(c.ior), f(c.extinction), f(c.dip), f(c.exponent)};
          return Model<F>::make(channel).eval(F(ScalarOf<F>(cosine)));
        };
        test::expect_alike(truth, 2e-5, 0.1, at,
                           std::string(Model<double>::name) + " case " + std::to_string(k) +
                               " cosine " + std::to_string(cosine));
      }
    }
  });
}

// 2 INT F(c) c dc; above the critical cosine of total reflection, if there is one, c - critical is
// a square.
template <class Model>
double integrated_average(const Model& model, double critical) {
  static const Rule rule = gauss_legendre(200);
  double sum = critical * critical;
  for (size_t i = 0; i < rule.nodes.size(); ++i) {
    const double c = critical + (1 - critical) * square(rule.nodes[i]);
    sum += rule.weights[i] * 4 * (1 - critical) * rule.nodes[i] * c * model.eval(c);
  }
  return sum;
}

template <class Model>
bool is_clamped(const Model& model) {
  for (int i = 1; i < 100; ++i) {
    if (model.eval(i / 100.0) <= 0 || model.eval(i / 100.0) >= 1) return true;
  }
  return false;
}

TEST(EveryFresnel, AveragesAlikeAtEveryNumberType) {
  Fresnels::for_each([]<template <class> class Model>() {
    for (const double n : {0.25, 1.03125, 1.5, 2.5}) {
      const auto average = [n]<class F>() {
        const FresnelChannel<F> channel{
            .f0 = F(0.25), .f82 = F(0.5), .ior = F(n), .extinction = F(3)};
        return Model<F>::make(channel).average();
      };
      test::expect_alike(average.template operator()<double>(), 1e-5, 0.1, average,
                         Model<double>::name);
    }
  });
}

TEST(EveryFresnel, AveragesToItsIntegral) {
  Fresnels::for_each([]<template <class> class Model>() {
    for (const FresnelChannel<double>& channel : channels<double>()) {
      const bool dielectric = Model<double>::name == "dielectric";
      // Twelve points do not resolve total reflection with little extinction.
      if (!dielectric && channel.ior < 1.1 && channel.extinction < 1) continue;
      const Model<double> model = Model<double>::make(channel);
      const double inside = std::min(channel.ior, 1.0);
      const double sum = integrated_average(model, dielectric ? std::sqrt(1 - inside * inside) : 0);
      const bool clamped = !dielectric && is_clamped(model);
      EXPECT_NEAR(model.average(), sum,
                  clamped      ? 1e-3
                  : dielectric ? 1e-11
                               : 1e-6)
          << Model<double>::name << " f0 " << channel.f0 << " f82 " << channel.f82 << " n "
          << channel.ior << " k " << channel.extinction;
    }
  });
}

// Albedo terms of a rough lobe, of two directions and on average.
Albedo<double> rough_albedo() { return {{0.55, 0.06}, {0.4, 0.2}, {0.5, 0.08}}; }

TEST(EveryEnergy, MakesAWhiteLobeReflectAllThatItReceives) {
  const Albedo<double> albedo = rough_albedo();
  const ChannelEnergy<double> white{1, 1, albedo.o.total()};
  Energies::for_each([&]<template <class> class Model>() {
    if (Model<double>::name == "none") return;
    EXPECT_NEAR(Model<double>::total(white, albedo), 1, 1e-12) << Model<double>::name;
  });
}

TEST(EveryEnergy, ReflectsAtLeastTheFirstBounceAndNeverMoreThanItReceives) {
  const Albedo<double> albedo = rough_albedo();
  Energies::for_each([&]<template <class> class Model>() {
    for (const double f0 : {0.0, 0.04, 0.5, 0.9}) {
      const double first = f0 * albedo.o.scale + albedo.o.bias;
      const ChannelEnergy<double> channel{f0, f0 + (1 - f0) / 21, first};
      const double total = Model<double>::total(channel, albedo);
      EXPECT_GE(total, first) << Model<double>::name;
      EXPECT_LE(total, 1) << Model<double>::name;
    }
  });
}

TEST(EveryEnergy, SaysWhetherDirectionsMayBeSwapped) {
  const Albedo<double> there = rough_albedo(), back{there.i, there.o, there.average};
  const auto channel = [](const SplitSumTerms<double>& terms) {
    return ChannelEnergy<double>{0.5, 0.5 + 0.5 / 21, 0.5 * terms.scale + terms.bias};
  };
  Energies::for_each([&]<template <class> class Model>() {
    const auto f = [&](const Albedo<double>& albedo) {
      const auto c = channel(albedo.o);
      return 0.3 * Model<double>::scale(c, albedo) + Model<double>::added(c, albedo);
    };
    EXPECT_EQ(std::abs(f(there) - f(back)) < 1e-12, Model<double>::reciprocal)
        << Model<double>::name;
  });
}

template <class F>
Albedo<F> rough_albedo_as() {
  const auto terms = [](const SplitSumTerms<double>& t) {
    return SplitSumTerms<F>{F(ScalarOf<F>(t.scale)), F(ScalarOf<F>(t.bias))};
  };
  const Albedo<double> albedo = rough_albedo();
  return {terms(albedo.o), terms(albedo.i), terms(albedo.average)};
}

TEST(EveryEnergy, AgreesAtEveryNumberType) {
  Energies::for_each([]<template <class> class Model>() {
    const auto total = []<class F>() {
      return Model<F>::total({F(0.5), F(0.5625), F(0.25)}, rough_albedo_as<F>());
    };
    const auto eval = []<class F>() {
      const ChannelEnergy<F> channel{F(0.5), F(0.5625), F(0.25)};
      const Albedo<F> albedo = rough_albedo_as<F>();
      return fma(F(0.25), Model<F>::scale(channel, albedo), Model<F>::added(channel, albedo));
    };
    const std::string_view name = Model<double>::name;
    test::expect_alike(total.template operator()<double>(), 16 * 6e-8, 0, total, name);
    test::expect_alike(eval.template operator()<double>(), 16 * 6e-8, 0, eval, name);
  });
}

TEST(EveryCoupling, AgreesAtEveryNumberType) {
  Couplings::for_each([]<template <class> class Model>() {
    for (const bool constant : {false, true}) {
      const auto weight = [constant]<class F>() {
        const SpecularChannel<F> plastic{F(0.0625), F(1), F(0.015625)};
        return Model<F>::weight(plastic, rough_albedo_as<F>(), constant);
      };
      test::expect_alike(weight.template operator()<double>(), 16 * 6e-8, 0, weight,
                         Model<double>::name);
    }
  });
}

TEST(EveryCoupling, LeavesNoMoreThanTheSpecularLobeDoes) {
  const Albedo<double> albedo = rough_albedo(), back{albedo.i, albedo.o, albedo.average};
  const SpecularChannel<double> plastic{0.04, 1, 0.01};
  Couplings::for_each([&]<template <class> class Model>() {
    const double weight = Model<double>::weight(plastic, albedo, false);
    EXPECT_GE(weight, 0) << Model<double>::name;
    EXPECT_LE(weight, 1 - plastic.reflectance(albedo.o) + 1e-15) << Model<double>::name;
    const bool alike = std::abs(weight - Model<double>::weight(plastic, back, false)) < 1e-12;
    EXPECT_EQ(alike, Model<double>::reciprocal) << Model<double>::name;
  });
}

}  // namespace
}  // namespace kiln
