// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "kiln/brdf/models.h"
#include "kiln/integrate/gauss_legendre.h"
#include "kiln/table/view_rule.h"

namespace kiln {

// The integral of a lobe over half vectors in slope space, for any distribution and masking. It
// runs in two stages over blocks that stay in the first-level cache: the lobe makes weights and
// half-vector cosines, then a Fresnel stage sums what it wants of them. So the code grows as the
// sum of lobes and Fresnel terms, not as their product.

using Wide = WideDouble;
inline constexpr int wide_lanes = lane_count<Wide>;
inline constexpr int most_slopes = 256;
inline constexpr int most_sums = 3;

/// Quadrature points of one vector of azimuths: lobe weights and cosines c = wo.wm.
struct PointBlock {
  int count = 0;
  std::array<Wide, most_slopes> weight, cosine;
};

struct LobeWidth {
  double alpha_x = 1, alpha_y = 1;
  double shape = 0;         ///< of distributions that have one
  double view_azimuth = 0;  ///< of wo from the x axis [rad]; read where alpha_x != alpha_y
};

/// Adds to the sums what a Fresnel stage makes of a block.
struct FresnelStage {
  void (*add)(const PointBlock& block, const FresnelChannel<double>& fresnel, Wide* sums) = nullptr;
  FresnelChannel<double> fresnel = {};
};

using LobeKernel = void (*)(const ViewRule& view, const LobeWidth& width, const Rule& slopes,
                            const FresnelStage& stage, Wide* sums);

/// How slopes spread for a distribution: nodes crowd around `scale`, none lies beyond `reach`,
/// where the density has fallen below 1e-21 of its peak.
template <class Distribution>
struct SlopeSpread {
  static Wide scale(Wide alpha) { return alpha; }
  static Wide reach(Wide) { return Wide(1e300); }
};
template <>
struct SlopeSpread<Beckmann<Wide>> {
  static Wide scale(Wide alpha) { return alpha; }
  static Wide reach(Wide alpha) { return Wide(7.0) * alpha; }
};
template <>
struct SlopeSpread<Phong<Wide>> {
  static Wide scale(Wide alpha) { return alpha; }
  // (1 + t^2)^(-1/alpha^2) = e^-49
  static Wide reach(Wide alpha) {
    return sqrt(exp(min(Wide(49.0) * alpha * alpha, Wide(600.0))) - Wide(1.0));
  }
};
template <>
struct SlopeSpread<Charlie<Wide>> {  // peaks at grazing microfacets: no scale but that of the disc
  static Wide scale(Wide) { return Wide(1.0); }
  static Wide reach(Wide) { return Wide(1e300); }
};

/// Lane for lane of azimuths: what the integrand needs of view and azimuth.
struct AzimuthLanes {
  Vec3<Wide> wo;         // frame of the distribution
  Wide cos_q, sin_q;     // of the slope's azimuth, same frame
  Wide mu, sine, cos_p;  // view frame
  Wide tau_cos_p, t_max, inverse_t_max;
};

// Adds the point at the slope t. With wi found from the slope,
// n.wi = mu (tmax - t)(t + 1/tmax) / (1 + t^2), which keeps its digits next to the horizon, and the
// half-vector cosine is c = (mu + sine t cos p) / sqrt(1 + t^2).
template <template <class> class Masking, class Distribution>
void add_point(const AzimuthLanes& at, const Distribution& distribution, Wide t, Wide dt,
               PointBlock& block) {
  const Wide inverse = Wide(1.0) / fma(t, t, Wide(1.0));
  const Wide root = sqrt(inverse);
  const Wide c = fma(at.sine * t, at.cos_p, at.mu) * root;
  const Vec3<Wide> wm{t * at.cos_q * root, t * at.sin_q * root, root};
  Vec3<Wide> wi = wm * (c + c) - at.wo;
  wi.z = max(at.mu * (at.t_max - t) * (t + at.inverse_t_max) * inverse, Wide(1e-150));
  const Wide g2 = Masking<Wide>::G2(distribution, at.wo, wi, wm);
  const Wide lobe =
      distribution.D(wm) * inverse * inverse * t * fma(t, at.tau_cos_p, Wide(1.0)) * g2;
  block.weight[block.count] = lobe * dt;
  block.cosine[block.count++] = c;
}

// The inner integral for one vector of azimuths. With t = a sinh x all scales between a and the end
// are equal. The Gauss nodes come in pairs xi, 1 - xi, and e^((1 - xi) X) = e^X / e^(xi X), so one
// exponential serves two nodes.
template <template <class> class Masking, class Distribution>
void fill_block(const AzimuthLanes& at, const Distribution& distribution, Wide alpha, Wide weight,
                const Rule& rule, PointBlock& block) {
  using Spread = SlopeSpread<Distribution>;
  const Wide scale = Spread::scale(alpha);
  const Wide end = min(at.t_max, Spread::reach(alpha)) / scale;
  const Wide e_x = end + sqrt(fma(end, end, Wide(1.0)));
  const Wide inverse_e_x = Wide(1.0) / e_x;
  const Wide x_max = log(e_x);
  const Wide half = Wide(0.5) * scale;
  const Wide step = half * x_max * weight;
  block.count = 0;
  const auto add = [&](Wide p, Wide inverse_p, double w) {
    add_point<Masking>(at, distribution, half * (p - inverse_p), step * (p + inverse_p) * Wide(w),
                       block);
  };
  const int n = static_cast<int>(rule.nodes.size());
  for (int j = 0; j < n / 2; ++j) {
    const Wide p = exp(x_max * Wide(rule.nodes[j]));
    const Wide inverse_p = Wide(1.0) / p;
    add(p, inverse_p, rule.weights[j]);
    add(e_x * inverse_p, inverse_e_x * p, rule.weights[j]);
  }
  if (n % 2 == 1) {
    const Wide p = sqrt(e_x);
    add(p, Wide(1.0) / p, rule.weights[n / 2]);
  }
}

// One of the two half circles: the mirrored one has sin p of the other sign.
template <template <class> class Masking, class Distribution>
void add_half_circle(const ViewRule& view, const LobeWidth& width, const Rule& slopes, double side,
                     double share, const FresnelStage& stage, Wide* sums) {
  const auto distribution =
      Distribution::make(Wide(width.alpha_x), Wide(width.alpha_y), Wide(width.shape));
  const double cos_v = std::cos(width.view_azimuth), sin_v = std::sin(width.view_azimuth);
  AzimuthLanes at{};
  at.mu = Wide(view.mu);
  at.sine = Wide(view.sine);
  at.wo = {Wide(view.sine * cos_v), Wide(view.sine * sin_v), Wide(view.mu)};
  PointBlock block;
  for (size_t k = 0; k < view.weight.size(); k += wide_lanes) {
    at.cos_p = load_lanes<Wide>(&view.cos_p[k]);
    const Wide sin_p = load_lanes<Wide>(&view.sin_p[k]) * Wide(side);
    at.cos_q = at.cos_p * Wide(cos_v) - sin_p * Wide(sin_v);
    at.sin_q = at.cos_p * Wide(sin_v) + sin_p * Wide(cos_v);
    at.tau_cos_p = Wide(view.tau) * at.cos_p;
    at.t_max = load_lanes<Wide>(&view.t_max[k]);
    at.inverse_t_max = Wide(1.0) / at.t_max;
    const Wide along = Wide(1.0) / sqrt(square(at.cos_q / Wide(width.alpha_x)) +
                                        square(at.sin_q / Wide(width.alpha_y)));
    const Wide weight = load_lanes<Wide>(&view.weight[k]) * Wide(share);
    fill_block<Masking>(at, distribution, along, weight, slopes, block);
    stage.add(block, stage.fresnel, sums);
  }
}

/// The kernel of one pair of models.
template <template <class> class Distribution, template <class> class Masking>
void integrate_lobe(const ViewRule& view, const LobeWidth& width, const Rule& slopes,
                    const FresnelStage& stage, Wide* sums) {
  const bool symmetric = width.alpha_x == width.alpha_y || width.view_azimuth == 0;
  if (symmetric) {
    add_half_circle<Masking, Distribution<Wide>>(view, width, slopes, 1, 1, stage, sums);
    return;
  }
  add_half_circle<Masking, Distribution<Wide>>(view, width, slopes, 1, 0.5, stage, sums);
  add_half_circle<Masking, Distribution<Wide>>(view, width, slopes, -1, 0.5, stage, sums);
}

}  // namespace kiln
