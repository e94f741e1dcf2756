// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <random>

#include "kiln/brdf/beckmann.h"
#include "kiln/brdf/ggx.h"
#include "kiln/brdf/schlick.h"

namespace kiln::test {

// A random walk on the Smith microsurface of a distribution, isotropic: light enters along -wo,
// meets a microfacet at a random height, is mirrored, and so on until it leaves. The truth that
// models of multiple scattering approximate.
// Source: Heitz, Hanika, d'Eon and Dachsbacher 2016.

/// Smith's Lambda of any direction: Lambda(-w) = -1 - Lambda(w).
template <class Model>
double signed_lambda(const Model& model, const Vec3<double>& w) {
  if (w.z > 0) return model.lambda(w);
  return -1 - model.lambda({w.x, w.y, -w.z});
}

/// A microfacet normal of GGX visible from any direction, by the whole spherical cap.
template <class Random>
Vec3<double> sample_visible_from(const Ggx<double>& ggx, const Vec3<double>& w, Random& random) {
  std::uniform_real_distribution<double> uniform(0, 1);
  const Vec3<double> up = normalize(Vec3<double>{ggx.alpha_x * w.x, ggx.alpha_y * w.y, w.z});
  const double phi = 2 * pi * uniform(random);
  const double z = (1 - uniform(random)) * (1 + up.z) - up.z, r = safe_sqrt(1 - z * z);
  const Vec3<double> h = Vec3<double>{r * std::cos(phi), r * std::sin(phi), z} + up;
  return normalize(Vec3<double>{ggx.alpha_x * h.x, ggx.alpha_y * h.y, std::max(h.z, 1e-12)});
}

/// The share of the facing area of Gaussian slopes below s, not normalised:
/// INT_-inf^s (c - x) exp(-x^2) / sqrt(pi) dx.
inline double facing_below(double s, double c) {
  return 0.5 * c * std::erfc(-s) + std::exp(-s * s) / (2 * std::sqrt(pi));
}

/// A microfacet normal of Beckmann's visible from any direction: the slope along the direction by
/// bisection, the one across it is Gaussian.
template <class Random>
Vec3<double> sample_visible_from(const Beckmann<double>& beckmann, const Vec3<double>& w,
                                 Random& random) {
  std::uniform_real_distribution<double> uniform(0, 1);
  const double sine = std::sqrt(w.x * w.x + w.y * w.y);
  const double c = w.z / (beckmann.alpha_x * std::max(sine, 1e-12));
  double low = -9, high = std::min(c, 9.0);
  const double wanted = uniform(random) * facing_below(high, c);
  for (int step = 0; step < 32; ++step) {
    const double middle = 0.5 * (low + high);
    (facing_below(middle, c) < wanted ? low : high) = middle;
  }
  const double radius = std::sqrt(-std::log(1 - uniform(random)));
  const double across = beckmann.alpha_x * radius * std::cos(2 * pi * uniform(random));
  const double along = -beckmann.alpha_x * low;
  const double x = sine > 1e-9 ? w.x / sine : 1, y = sine > 1e-9 ? w.y / sine : 0;
  return normal_of_slopes(x * along - y * across, y * along + x * across);
}

struct WalkResult {
  int bounces = 0;
  double weight = 1;  ///< product of the Fresnel reflectances
};

/// One walk; `most` bounces end it.
template <class Model, class Random>
WalkResult walk_microsurface(const Model& model, const Vec3<double>& wo,
                             const Schlick<double>& fresnel, Random& random, int most = 1000) {
  std::uniform_real_distribution<double> uniform(0, 1);
  Vec3<double> w = -wo;
  double height = 1;  // as its share of heights below
  WalkResult result;
  while (result.bounces < most) {
    const double lambda = signed_lambda(model, w), u = uniform(random);
    if (w.z > 0 && u > 1 - std::pow(height, lambda)) return result;
    height = std::min(height / std::pow(1 - u, 1 / lambda), 1.0);
    const Vec3<double> wm = sample_visible_from(model, -w, random);
    const double cosine = std::max(-dot(w, wm), 0.0);
    result.weight *= fresnel.eval(cosine);
    w = normalize(w + wm * (2 * cosine));
    ++result.bounces;
  }
  return result;
}

}  // namespace kiln::test
