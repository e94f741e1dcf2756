// SPDX-License-Identifier: Apache-2.0
// Every distribution and every masking on the lists, and every pair that fits together.
#include <gtest/gtest.h>

#include <cmath>

#include "kiln/brdf/models.h"
#include "kiln/brdf/surface.h"
#include "kiln/integrate/gauss_legendre.h"
#include "support/agreement.h"
#include "support/directions.h"
#include "support/faults.h"

namespace kiln {
namespace {

using test::direction;

constexpr double shapes_of_any[] = {0.75, 1, 1.75, 2, 3.5, 8};

// The shapes to try of a model: its corners, or the one that it has.
template <class Model>
std::vector<double> shapes() {
  std::vector<double> tried;
  if constexpr (requires { Model::default_shape; }) {
    const ModelParam& shape = Model::params.back();
    for (double s : shapes_of_any) {
      if (s >= shape.min && s <= shape.max) tried.push_back(s);
    }
  } else {
    tried.push_back(0);
  }
  return tried;
}

struct Widths {
  double x, y;
};

template <class Model>
std::vector<Widths> widths() {
  std::vector<Widths> tried = {{1e-4, 1e-4}, {1e-3, 1e-3}, {0.01, 0.01}, {0.1, 0.1},
                               {0.3, 0.3},   {0.5, 0.5},   {0.8, 0.8},   {1, 1}};
  if (Model::anisotropic) {
    tried.insert(tried.end(), {{0.05, 0.8}, {0.6, 0.1}, {1e-3, 0.02}, {1, 0.3}});
  }
  return tried;
}

// INT D(m) m.z dm in slopes stretched by the widths, t = sinh x: all scales are equal, and the
// limit leaves out less than 1e-10 even of a tail t^-2.
template <class Model>
double projected_area(const Model& model) {
  static const Rule rule = gauss_legendre(48);
  constexpr int panels = 10, azimuths = 32;
  const double reach = std::asinh(1e9 / std::min(model.alpha_x, model.alpha_y));
  double sum = 0;
  for (int j = 0; j < azimuths; ++j) {
    const double phi = 2 * pi * (j + 0.5) / azimuths;
    for (int panel = 0; panel < panels; ++panel) {
      for (size_t i = 0; i < rule.nodes.size(); ++i) {
        const double x = reach * (panel + rule.nodes[i]) / panels;
        const double t = std::sinh(x);
        const auto wm =
            normal_of_slopes(model.alpha_x * t * std::cos(phi), model.alpha_y * t * std::sin(phi));
        const double slopes = model.D(wm) * square(square(wm.z)) * model.alpha_x * model.alpha_y;
        sum += slopes * t * std::cosh(x) * rule.weights[i];
      }
    }
  }
  return sum * reach / panels * 2 * pi / azimuths;
}

TEST(EveryDistribution, HasAProjectedAreaOfOne) {
  Distributions::for_each([]<template <class> class Model>() {
    for (const double shape : shapes<Model<double>>()) {
      for (const Widths& w : widths<Model<double>>()) {
        const auto model = make_distribution<Model<double>>(w.x, w.y, shape);
        EXPECT_NEAR(projected_area(model), 1, 1e-9)
            << Model<double>::name << " alpha " << w.x << " " << w.y << " shape " << shape;
      }
    }
  });
}

TEST(EveryDistribution, IsZeroBelowTheSurfaceAndFiniteAtTheHorizon) {
  const auto check = []<class F, template <class> class Model>() {
    for (const Widths& w : widths<Model<double>>()) {
      const auto model = make_distribution<Model<F>>(F(w.x), F(w.y), 0);
      EXPECT_EQ(test::first_lane(model.D({F(0.6), F(0), F(-0.8)})), 0) << Model<F>::name;
      for (const double z : {1e-30, 1e-7, 1.0}) {
        const Vec3<F> wm{F(std::sqrt(1 - z * z)), F(0), F(z)};
        const double d = test::first_lane(model.D(wm));
        EXPECT_TRUE(std::isfinite(d) && d >= 0) << Model<F>::name << " z " << z << " D " << d;
      }
    }
  };
  Distributions::for_each([&]<template <class> class Model>() {
    check.template operator()<double, Model>();
    check.template operator()<float, Model>();
    check.template operator()<WideFloat, Model>();
  });
}

// ln of what a narrow lobe loses away from its peak is what rounding is multiplied by.
TEST(EveryDistribution, AgreesAtEveryNumberType) {
  Distributions::for_each([]<template <class> class Model>() {
    for (const double shape : shapes<Model<double>>()) {
      for (const Widths& w : widths<Model<double>>()) {
        const double x = static_cast<float>(w.x), y = static_cast<float>(w.y);
        const auto oracle = make_distribution<Model<double>>(x, y, shape);
        for (const Vec3<double>& wm : test::lobe_directions(w.x, 60)) {
          const double truth = oracle.D(wm);
          const double spread = std::abs(std::log(std::max(truth * x * y, 1e-37)));
          test::expect_alike(
              truth, (16 + 4 * spread + 8 * shape) * 6e-8, 1e-25,
              [&]<class F>() {
                return make_distribution<Model<F>>(F(ScalarOf<F>(x)), F(ScalarOf<F>(y)), shape)
                    .D(test::as<F>(wm));
              },
              Model<double>::name);
        }
      }
    }
  });
}

// Tangents of the drawn normals; azimuths are compared through the two slopes.
TEST(EveryDistribution, IsSampledAlikeAtEveryNumberType) {
  Distributions::for_each([]<template <class> class Model>() {
    for (const double shape : shapes<Model<double>>()) {
      for (const Widths& w : widths<Model<double>>()) {
        const double x = static_cast<float>(w.x), y = static_cast<float>(w.y);
        for (const double u : {0.125, 0.6875}) {
          for (const double v : {0.0078125, 0.5, 0.9375}) {
            const auto drawn = [&]<class F>() {
              return make_distribution<Model<F>>(F(ScalarOf<F>(x)), F(ScalarOf<F>(y)), shape)
                  .sample({F(u), F(v)});
            };
            const auto across = [&]<class F>() { return drawn.template operator()<F>().x; };
            const auto up = [&]<class F>() { return drawn.template operator()<F>().z; };
            const Vec3<double> wm = drawn.template operator()<double>();
            test::expect_alike(wm.x, 1e-5, 1e-5, across, Model<double>::name);
            test::expect_alike(wm.z, 1e-5, 1e-5, up, Model<double>::name);
            EXPECT_NEAR(dot(wm, wm), 1, 1e-12) << Model<double>::name;
          }
        }
      }
    }
  });
}

TEST(EveryDistribution, WithALambdaHasItGrowTowardGrazing) {
  Distributions::for_each([]<template <class> class Model>() {
    if constexpr (Model<double>::has_lambda) {
      for (const Widths& w : widths<Model<double>>()) {
        const auto model = make_distribution<Model<double>>(w.x, w.y, 0);
        double before = 0;
        for (double mu = 1; mu > 0; mu -= 1e-3) {
          const double lambda = model.lambda(direction(mu, 0.4));
          EXPECT_GE(lambda, before - 1e-15) << Model<double>::name << " mu " << mu;
          before = lambda;
        }
      }
    }
  });
}

TEST(EveryDistribution, WithALambdaHasTheSameAtEveryNumberType) {
  Distributions::for_each([]<template <class> class Model>() {
    if constexpr (Model<double>::has_lambda) {
      for (const Widths& w : widths<Model<double>>()) {
        const double x = static_cast<float>(w.x), y = static_cast<float>(w.y);
        const auto oracle = make_distribution<Model<double>>(x, y, 0);
        for (const Vec3<double>& wo : test::lobe_directions(1, 60)) {
          const double truth = oracle.lambda(wo);
          const double spread = std::abs(std::log(std::max(truth, 1e-30)));
          test::expect_alike(
              truth, (16 + 4 * spread) * 6e-8, 1e-30,
              [&]<class F>() {
                return make_distribution<Model<F>>(F(ScalarOf<F>(x)), F(ScalarOf<F>(y)), 0)
                    .lambda(test::as<F>(wo));
              },
              Model<double>::name);
        }
      }
    }
  });
}

// Calls visit(distribution, Masking, wo, wi) for every pair that fits, a few widths and directions.
template <class Visit>
void for_each_case(Visit&& visit) {
  for_each_lobe([&]<template <class> class Model, template <class> class Masking>() {
    for (const double alpha : {0.01, 0.25, 1.0}) {
      const auto model = Model<double>::isotropic(static_cast<float>(alpha));
      for (const Vec3<double>& a : test::hemisphere(16)) {
        for (const Vec3<double>& b : test::hemisphere(13)) {
          const std::string label =
              std::string(Model<double>::name) + " " + std::string(Masking<double>::name);
          visit.template operator()<Model, Masking>(model, a, b, label);
        }
      }
    }
  });
}

TEST(EveryLobe, HasAMaskingBetweenZeroAndOneThatKnowsNoOrder) {
  for_each_case([]<template <class> class Model, template <class> class Masking>(
                    const Model<double>& model, const Vec3<double>& wo, const Vec3<double>& wi,
                    const std::string& label) {
    const Vec3<double> wm = half_vector(wo, wi);
    const double there = Masking<double>::G2(model, wo, wi, wm);
    EXPECT_GE(there, 0) << label;
    EXPECT_LE(there, 1 + 1e-14) << label;
    EXPECT_NEAR(there, Masking<double>::G2(model, wi, wo, wm), 1e-13 * there) << label;
    const double v = Masking<double>::visibility(model, wo, wi, wm);
    EXPECT_NEAR(v, there / (4 * wo.z * wi.z), 1e-12 * v) << label;
  });
}

TEST(EveryLobe, MasksTwoDirectionsAtLeastAsMuchAsEither) {
  for_each_case([]<template <class> class Model, template <class> class Masking>(
                    const Model<double>& model, const Vec3<double>& wo, const Vec3<double>& wi,
                    const std::string& label) {
    if constexpr (Masking<double>::one_sided) {
      const Vec3<double> wm = half_vector(wo, wi);
      const double one_o = Masking<double>::G1(model, wo, wm);
      const double one_i = Masking<double>::G1(model, wi, wm);
      EXPECT_LE(Masking<double>::G2(model, wo, wi, wm), std::min(one_o, one_i) + 1e-14) << label;
      EXPECT_LE(std::max(one_o, one_i), 1 + 1e-14) << label;
      EXPECT_GE(std::min(one_o, one_i), 0) << label;
    }
  });
}

TEST(EveryLobe, IsMaskedAlikeAtEveryNumberType) {
  for_each_case([]<template <class> class Model, template <class> class Masking>(
                    const Model<double>& model, const Vec3<double>& a, const Vec3<double>& b,
                    const std::string& label) {
    const Vec3<double> wo = test::rounded(a), wi = test::rounded(b);
    const Vec3<double> wm = test::rounded(half_vector(wo, wi));
    const auto narrow = [&]<class F>() {
      return Model<F>::isotropic(F(ScalarOf<F>(model.alpha_x)));
    };
    const auto as = []<class F>(const Vec3<double>& w) { return test::as<F>(w); };
    test::expect_alike(
        Masking<double>::G2(model, wo, wi, wm), 32 * 6e-8, 1e-12,
        [&]<class F>() {
          return Masking<F>::G2(narrow.template operator()<F>(), as.template operator()<F>(wo),
                                as.template operator()<F>(wi), as.template operator()<F>(wm));
        },
        label);
    test::expect_alike(
        Masking<double>::visibility(model, wo, wi, wm), 32 * 6e-8, 1e-12,
        [&]<class F>() {
          return Masking<F>::visibility(
              narrow.template operator()<F>(), as.template operator()<F>(wo),
              as.template operator()<F>(wi), as.template operator()<F>(wm));
        },
        label);
  });
}

// The integral over a range by Gauss-Legendre in panels of about 3.
template <class Integrand>
double integrate(double from, double to, const Integrand& f) {
  static const Rule rule = gauss_legendre(20);
  const int panels = static_cast<int>(std::ceil((to - from) / 3));
  const double step = (to - from) / panels;
  double sum = 0;
  for (int panel = 0; panel < panels; ++panel) {
    for (size_t i = 0; i < rule.nodes.size(); ++i) {
      sum += rule.weights[i] * f(from + step * (panel + rule.nodes[i]));
    }
  }
  return sum * step;
}

// INT G1 max(0, o.m) D dm / mu_o, the weak white furnace. In stretched slopes u along the view and
// v across, o.m = m.z (mu - u L): the horizon is the line u = mu / L and the kink of the grooves
// u = -mu / L, so that between them all is smooth.
template <class Masking, class Model>
double visible_area(const Model& model, const Vec3<double>& wo) {
  const double x = model.alpha_x * wo.x, y = model.alpha_y * wo.y;
  const double stretched = std::sqrt(x * x + y * y);
  const double cosine = stretched > 0 ? x / stretched : 1, sine = stretched > 0 ? y / stretched : 0;
  const auto at = [&](double u, double v) {
    const auto wm = normal_of_slopes(-model.alpha_x * (cosine * u - sine * v),
                                     -model.alpha_y * (sine * u + cosine * v));
    const double facing = std::max(dot(wo, wm), 0.0), z2 = wm.z * wm.z;
    return Masking::G1(model, wo, wm) * facing * model.D(wm) * z2 * wm.z;
  };
  const double reach = std::asinh(1e10);
  const double edge = std::asinh(std::min(wo.z / std::max(stretched, 1e-12), 1e10));
  const auto over_u = [&](double v) {
    const auto f = [&](double p) { return at(std::sinh(p), v) * std::cosh(p); };
    return integrate(-reach, -edge, f) + integrate(-edge, edge, f);
  };
  const auto over_v = [&](double p) { return over_u(std::sinh(p)) * std::cosh(p); };
  return integrate(-reach, reach, over_v) * model.alpha_x * model.alpha_y / wo.z;
}

// What the visible area of a lobe is at worst, of the widths and directions tried.
template <template <class> class Model, template <class> class Masking>
double worst_visible_area() {
  double worst = 1;
  for (const double alpha : {0.1, 0.5, 1.0}) {
    for (const double mu : {1e-3, 0.1, 0.5, 1.0}) {
      const double area =
          visible_area<Masking<double>>(Model<double>::isotropic(alpha), direction(mu, 0));
      if (std::abs(area - 1) > std::abs(worst - 1)) worst = area;
    }
  }
  return worst;
}

// Exact Smith masking and grooves conserve the visible area of microfacets; what the other models
// make of it is recorded, not judged.
TEST(EveryLobe, OfASurfaceModelConservesTheVisibleArea) {
  for_each_lobe([]<template <class> class Model, template <class> class Masking>() {
    if constexpr (Masking<double>::one_sided) {
      const double worst = worst_visible_area<Model, Masking>();
      const std::string label =
          std::string(Masking<double>::name) + "." + std::string(Model<double>::name);
      RecordProperty("visible_area." + label, std::to_string(worst));
      const std::string_view masking = Masking<double>::name;
      const bool smith = masking == "smith-correlated" || masking == "smith-separable";
      if ((smith && Model<double>::exact_lambda) || masking == "v-cavity") {
        // A power of the sine has a point at the pole, which the panels do not resolve.
        EXPECT_NEAR(worst, 1, Model<double>::alpha_is_width ? 1e-7 : 1e-4) << label;
      }
    }
  });
}

TEST(EveryLobe, OfTwoWidthsConservesTheVisibleAreaToo) {
  using Smith = SmithCorrelated<double>;
  for (const double phi : {0.0, 0.7, pi / 2}) {
    for (const double mu : {0.02, 0.4}) {
      const Vec3<double> wo = direction(mu, phi);
      EXPECT_NEAR(visible_area<Smith>(Ggx<double>{0.1, 0.6}, wo), 1, 1e-7);
      EXPECT_NEAR(visible_area<Smith>(Beckmann<double>{0.5, 0.05}, wo), 1, 1e-7);
      EXPECT_NEAR(visible_area<VCavity<double>>(Phong<double>{0.3, 0.7}, wo), 1, 1e-7);
    }
  }
}

TEST(EveryLobe, IsFoundByItsNames) {
  std::string found;
  with_lobe("Student_T", "v-cavity",
            [&]<template <class> class Model, template <class> class Masking>() {
              found += std::string(Model<double>::name) + "/" + std::string(Masking<double>::name);
            });
  EXPECT_EQ(found, "student-t/v-cavity");
}

TEST(EveryLobe, ThatIsNotThereIsRefusedWithTheNamesThatAre) {
  const auto ignore = []<template <class> class, template <class> class>() {};
  const auto refusal = [&](const char* distribution, const char* masking) {
    return test::fault_text(Fault::Usage, [&] { with_lobe(distribution, masking, ignore); });
  };
  EXPECT_NE(refusal("bekmann", "kelemen").find("did you mean 'beckmann'"), std::string::npos);
  EXPECT_NE(refusal("ggx", "kelemenn").find("did you mean 'kelemen'"), std::string::npos);
  const std::string misfit = refusal("charlie", "smith-correlated");
  EXPECT_NE(misfit.find("does not fit distribution 'charlie'"), std::string::npos) << misfit;
  EXPECT_NE(misfit.find("estevez-kulla"), std::string::npos) << misfit;
}

}  // namespace
}  // namespace kiln
