// SPDX-License-Identifier: Apache-2.0
#include "kiln/material/lobe_error.h"

#include <algorithm>
#include <cmath>

#include "kiln/brdf/ggx.h"
#include "kiln/brdf/roughness.h"
#include "kiln/math/frame.h"
#include "kiln/math/hash.h"

namespace kiln {
namespace {

using W = WideFloat;
constexpr int lanes = lane_count<W>;
using Direction = Vec3<float>;

// Sums of D(h) and of D(h) cos over facets. With t = |h - n|^2 the sine is t (1 - t / 4), which has
// its digits near the peak.
template <class F>
void add_facets(const Facets& facets, int i, const Direction& h, F& density, F& projected) {
  const Vec3<F> n{load_lanes<F>(&facets.x[i]), load_lanes<F>(&facets.y[i]),
                  load_lanes<F>(&facets.z[i])};
  const F alpha = load_lanes<F>(&facets.alpha[i]);
  const Vec3<F> wide{F(h.x), F(h.y), F(h.z)};
  const Vec3<F> apart = wide - n;
  const F t = dot(apart, apart), cosine = dot(wide, n);
  const F squared = alpha * alpha;
  const F e = cosine * cosine + t * (F(1) - F(0.25) * t) / squared;
  const F d = select(cosine > F(0), F(1) / (F(pi) * squared * e * e), F(0));
  density += d;
  projected += d * max(cosine, F(0));
}

/// The average of the facets at a half-vector.
struct Average {
  double density = 0, projected = 0;
};

Average average_at(const Facets& facets, const Direction& h) {
  W density(0.0f), projected(0.0f);
  float rest_density = 0, rest_projected = 0;
  int i = 0;
  for (; i + lanes <= facets.count(); i += lanes) add_facets(facets, i, h, density, projected);
  for (; i < facets.count(); ++i) add_facets(facets, i, h, rest_density, rest_projected);
  const double share = 1.0 / facets.count();
  return {(xsimd::hadd(density) + rest_density) * share,
          (xsimd::hadd(projected) + rest_projected) * share};
}

// The frame of a normal, turned from +z the shortest way.
Frame<float> turned_from_z(const Direction& n) {
  const float k = 1.0f / (1.0f + n.z);
  return {{1.0f - k * n.x * n.x, -k * n.x * n.y, -n.x},
          {-k * n.x * n.y, 1.0f - k * n.y * n.y, -n.y},
          n};
}

Frame<float> frame_of(const OneLobe& lobe) {
  const Frame<float> turned = turned_from_z(lobe.normal);
  const float phi = static_cast<float>(pi) * lobe.angle;
  return {turned.x * std::cos(phi) + turned.y * std::sin(phi),
          turned.y * std::cos(phi) - turned.x * std::sin(phi), lobe.normal};
}

Vec2<float> point(int i, uint32_t seed) {
  // The additive recurrence of the plastic number, shifted by the seed.
  const auto shift = [](uint32_t bits) { return static_cast<double>(bits >> 8) / 16777216.0; };
  const double u = shift(mix_bits(seed)) + (i + 0.5) * 0.7548776662466927;
  const double v = shift(mix_bits(seed + 1)) + (i + 0.5) * 0.5698402909980532;
  const auto inside = [](double x) {
    return std::clamp(static_cast<float>(x - std::floor(x)), 1e-6f, 1.0f - 1e-6f);
  };
  return {inside(u), inside(v)};
}

}  // namespace

void Facets::add(const Vec3<float>& normal, float roughness) {
  x.push_back(normal.x);
  y.push_back(normal.y);
  z.push_back(normal.z);
  alpha.push_back(to_alpha(roughness));
}

LobeError lobe_error(const Facets& facets, const OneLobe& lobe, int samples, uint32_t seed) {
  const Ggx<float> ggx{std::max(lobe.alpha_x, static_cast<float>(min_alpha)),
                       std::max(lobe.alpha_y, static_cast<float>(min_alpha))};
  const Frame<float> frame = frame_of(lobe);
  double squared_error = 0, squared_average = 0;
  double peak = average_at(facets, lobe.normal).density;
  for (int i = 0; i < samples; ++i) {
    const Vec2<float> u = point(i / 2, seed);
    Direction h = frame.to_world(ggx.sample(u));
    if (i % 2 == 1) {
      const auto facet = static_cast<int>(combine_hash(seed, static_cast<uint32_t>(i)) %
                                          static_cast<uint32_t>(facets.count()));
      const Direction n{facets.x[facet], facets.y[facet], facets.z[facet]};
      peak = std::max(peak, average_at(facets, n).density);
      h = frame_around(n).to_world(Ggx<float>::isotropic(facets.alpha[facet]).sample(u));
    }
    const Average average = average_at(facets, h);
    const Direction local = frame.to_local(h);
    const double d = ggx.D(local);
    const double drawn = 0.5 * (average.projected + d * std::max(local.z, 0.0f));
    if (!(drawn > 0)) continue;
    peak = std::max(peak, average.density);
    squared_error += (d - average.density) * (d - average.density) / drawn;
    squared_average += average.density * average.density / drawn;
  }
  const double of_lobe = 1 / (pi * static_cast<double>(ggx.alpha_x) * ggx.alpha_y);
  return {of_lobe / peak - 1, std::sqrt(squared_error / std::max(squared_average, 1e-300))};
}

}  // namespace kiln
