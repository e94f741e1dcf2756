// SPDX-License-Identifier: Apache-2.0
#include "kiln/material/normal_filter.h"

#include <algorithm>

#include "kiln/material/normals.h"
#include "kiln/math/wide.h"

namespace kiln {
namespace {

using W = WideFloat;
constexpr int lanes = lane_count<W>;

W at(const float* row, int x) { return load_lanes<W>(row + x); }

// Of a normal (x, y, z) what Toksvig and Vmf average: x, y and 1 - z, which keeps the digits that
// nearly parallel normals differ in.
void fill_deviation(const SurfaceRow& row, int i, float* const* moments) {
  const W x = at(row.normal[0], i), y = at(row.normal[1], i), z = at(row.normal[2], i);
  store_lanes(moments[1] + i, x);
  store_lanes(moments[2] + i, y);
  store_lanes(moments[3] + i, fma(x, x, y * y) / (W(1) + z));
}

void fill_slopes(const SurfaceRow& row, int i, float* const* moments) {
  const W inverse = W(1) / max(at(row.normal[2], i), W(least_normal_z));
  const W x = at(row.normal[0], i) * inverse, y = at(row.normal[1], i) * inverse;
  store_lanes(moments[1] + i, x);
  store_lanes(moments[2] + i, y);
  store_lanes(moments[3] + i, x * x);
  store_lanes(moments[4] + i, y * y);
  store_lanes(moments[5] + i, x * y);
}

/// The mean normal of a footprint: its length N and 1 - N^2, by itself since N is close to 1.
struct MeanNormal {
  W length, lost;
};

MeanNormal mean_normal(const float* const* moments, int i) {
  const W x = at(moments[1], i), y = at(moments[2], i), d = at(moments[3], i);
  const W lost = clamp(d * (W(2) - d) - fma(x, x, y * y), W(0), W(1));
  return {max(sqrt(W(1) - lost), W(1e-3f)), lost};
}

// With v = 2 (1 - N) / N, Toksvig's s' = s N / (N + s (1 - N)) and alpha^2 = 2 / (s + 2) come to
//
//     alpha'^2 = (alpha^2 + (1 - alpha^2) v) / (1 + (1 - alpha^2) v)
//
// so that alpha^2 grows by (1 - alpha^2)^2 v / (1 + (1 - alpha^2) v).
W added_by_toksvig(W alpha_squared, const MeanNormal& mean) {
  const W v = W(2) * mean.lost / ((W(1) + mean.length) * mean.length);
  const W rest = W(1) - alpha_squared;
  return rest * rest * v / fma(rest, v, W(1));
}

// 2/k = 2 (1 - N), and (1 - N)(1 + N) is what the mean has lost.
W added_by_vmf(const MeanNormal& mean) { return W(2) * mean.lost / (W(1) + mean.length); }

/// A symmetric matrix.
struct Covariance {
  W xx, yy, xy;
};

// Slopes about the mean m, seen from the frame of the mean normal: with q = 1 + m^2 the Jacobian of
// that change of frame is J = (I - m m^T / (sqrt q (sqrt q + 1))) / sqrt q.
Covariance covariance(const float* const* moments, int i) {
  const W x = at(moments[1], i), y = at(moments[2], i);
  const Covariance s{max(at(moments[3], i) - x * x, W(0)), max(at(moments[4], i) - y * y, W(0)),
                     at(moments[5], i) - x * y};
  const W root = sqrt(fma(x, x, fma(y, y, W(1))));
  const W scale = W(1) / root, k = scale / (root + W(1));
  const W a = scale * (W(1) - k * x * x), b = -scale * k * x * y, d = scale * (W(1) - k * y * y);
  // J S J
  const W ax = a * s.xx + b * s.xy, ay = a * s.xy + b * s.yy;
  const W bx = b * s.xx + d * s.xy, by = b * s.xy + d * s.yy;
  return {max(ax * a + ay * b, W(0)), max(bx * b + by * d, W(0)), ax * b + ay * d};
}

/// What normals add to alpha^2 along the axes of the lobe.
struct Added {
  W x, y, angle;
};

// Eigenvalues of 2 S, and half the angle of (S_xx - S_yy, 2 S_xy).
Added added_by_lean(const Covariance& s) {
  const W mean = s.xx + s.yy, difference = s.xx - s.yy, mixed = W(2) * s.xy;
  const W spread = sqrt(fma(difference, difference, mixed * mixed));
  const W half_turns = atan2(mixed, difference) * W(static_cast<float>(0.5 / pi));
  return {mean + spread, max(mean - spread, W(0)),
          select(half_turns < W(0), half_turns + W(1), half_turns)};
}

/// Of one vector of texels: what is added, and to what.
template <class Add>
void write_isotropic(const NormalFiltering& filtering, int width, const float* const* moments,
                     const LobeRow& lobes, Add add) {
  const W strength(static_cast<float>(filtering.strength));
  const W most(static_cast<float>(filtering.most_added));
  for (int i = 0; i < width; i += lanes) {
    const W base = at(moments[0], i);
    const W squared = min(base + min(strength * add(base, i), most), W(1));
    const W alpha = sqrt(max(squared, W(0)));
    if (lobes.roughness != nullptr) store_lanes(lobes.roughness + i, W(sqrt(alpha)));
    if (lobes.alpha_x != nullptr) store_lanes(lobes.alpha_x + i, alpha);
    if (lobes.alpha_y != nullptr) store_lanes(lobes.alpha_y + i, alpha);
    if (lobes.angle != nullptr) store_lanes(lobes.angle + i, W(0));
  }
}

void write_anisotropic(const NormalFiltering& filtering, int width, const float* const* moments,
                       const LobeRow& lobes) {
  const W strength(static_cast<float>(filtering.strength));
  const W most(static_cast<float>(filtering.most_added));
  for (int i = 0; i < width; i += lanes) {
    const W base = at(moments[0], i);
    const Added added = added_by_lean(covariance(moments, i));
    const W x = min(base + min(strength * added.x, most), W(1));
    const W y = min(base + min(strength * added.y, most), W(1));
    if (lobes.alpha_x != nullptr) store_lanes(lobes.alpha_x + i, W(sqrt(max(x, W(0)))));
    if (lobes.alpha_y != nullptr) store_lanes(lobes.alpha_y + i, W(sqrt(max(y, W(0)))));
    if (lobes.angle != nullptr) store_lanes(lobes.angle + i, added.angle);
  }
}

}  // namespace

int moment_count(NormalFilter method) {
  switch (method) {
    case NormalFilter::None:
      return 1;
    case NormalFilter::Toksvig:
    case NormalFilter::Vmf:
      return 4;
    case NormalFilter::Lean:
      return 6;
  }
  return 1;
}

void fill_moments(NormalFilter method, const SurfaceRow& row, float* const* moments) {
  for (int i = 0; i < row.width; i += lanes) {
    const W r = at(row.roughness, i);
    store_lanes(moments[0] + i, W(square(square(r))));
  }
  if (method == NormalFilter::None) return;
  if (method == NormalFilter::Lean) {
    for (int i = 0; i < row.width; i += lanes) fill_slopes(row, i, moments);
  } else {
    for (int i = 0; i < row.width; i += lanes) fill_deviation(row, i, moments);
  }
}

void lobes_of_moments(const NormalFiltering& filtering, int width, const float* const* moments,
                      const LobeRow& lobes) {
  switch (filtering.method) {
    case NormalFilter::None:
      return write_isotropic(filtering, width, moments, lobes, [](W, int) { return W(0); });
    case NormalFilter::Toksvig:
      return write_isotropic(filtering, width, moments, lobes, [&](W base, int i) {
        return added_by_toksvig(base, mean_normal(moments, i));
      });
    case NormalFilter::Vmf:
      return write_isotropic(filtering, width, moments, lobes,
                             [&](W, int i) { return added_by_vmf(mean_normal(moments, i)); });
    case NormalFilter::Lean:
      break;
  }
  LobeRow isotropic;
  isotropic.roughness = lobes.roughness;
  if (isotropic.roughness != nullptr) {
    write_isotropic(filtering, width, moments, isotropic, [&](W, int i) {
      const Covariance s = covariance(moments, i);
      return s.xx + s.yy;  // half the trace of 2 S
    });
  }
  if (lobes.alpha_x != nullptr) write_anisotropic(filtering, width, moments, lobes);
}

}  // namespace kiln
