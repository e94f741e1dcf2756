// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "kiln/brdf/energy.h"
#include "kiln/table/lobe.h"

namespace kiln {

/// Where a roughness lies in an albedo table; found once per texel, used for every direction.
template <class F>
struct AlbedoRow {
  LaneIndex<F> first;  ///< entry (0, row)
  F blend;             ///< toward the next row
  F bend;              ///< c of the cosine axis
};

/// Integrals of a specular lobe, tabulated for texel loops: its split-sum terms, and the term of
/// c (1 - c)^6, which Fresnel models with a dip take; see LobeTerms.
///
/// Nodes lie on the borders. The axes spend them where the lobe changes: roughness is v^2, and the
/// cosine axis is u = mu (1 + r) / (mu + r), which bends at mu about r.
///
/// @accuracy  bilinear lookup of E, GGX with height-correlated Smith masking: 4e-4 for mu >= 0.02
/// and
///            roughness >= 0.1; 4e-4 rms; 1.5e-2 at worst, where mu < 1e-3 and roughness < 0.02
class AlbedoTable {
 public:
  static constexpr int nodes = 64;  ///< along each axis

  /// @error Fault::Usage for names that are not on the lists or do not fit each other
  static AlbedoTable build(const Lobe& lobe = {});

  /// The greatest E of the lobe at any node: above 1 it reflects more than it receives.
  double greatest() const { return greatest_; }

  /// @valid roughness in [0,1]; clamped, NaN reads as 0
  template <class F>
  AlbedoRow<F> row(F roughness) const {
    const F r = clamp(select(roughness == roughness, roughness, F(0)), F(0), F(1));
    const F y = sqrt(r) * F(nodes - 1);
    const F whole = min(floor(y), F(nodes - 2));
    return {to_index<F>(whole) * 2 * nodes, y - whole, max(r, F(least_bend))};
  }

  /// @valid mu in [0,1]; clamped
  template <class F>
  SplitSumTerms<F> terms(const AlbedoRow<F>& row, F mu) const {
    const F x = column(row, mu);
    const F whole = clamp(floor(x), F(0), F(nodes - 2));
    const F t = x - whole;
    const auto at = row.first + to_index<F>(whole) * 2;
    const float* e = entries_.data();
    const auto across = [&](int offset) {
      return lerp(gather(e + offset, at), gather(e + offset + 2, at), t);
    };
    return {lerp(across(0), across(2 * nodes), row.blend),
            lerp(across(1), across(2 * nodes + 1), row.blend)};
  }

  /// The integral of c (1 - c)^6.
  /// @valid mu in [0,1]; clamped
  template <class F>
  F edge(const AlbedoRow<F>& row, F mu) const {
    const F x = column(row, mu);
    const F whole = clamp(floor(x), F(0), F(nodes - 2));
    const F t = x - whole;
    const auto at = (row.first >> 1) + to_index<F>(whole);
    const float* e = edges_.data();
    return lerp(lerp(gather(e, at), gather(e + 1, at), t),
                lerp(gather(e + nodes, at), gather(e + nodes + 1, at), t), row.blend);
  }

  /// edge() averaged over directions.
  template <class F>
  F average_edge(const AlbedoRow<F>& row) const {
    const auto at = row.first / (2 * nodes);
    const float* e = edge_averages_.data();
    return lerp(gather(e, at), gather(e + 1, at), row.blend);
  }

  /// min(E, 1) averaged over directions: what a lobe that gains energy is taken to reflect.
  template <class F>
  F average_bounded(const AlbedoRow<F>& row) const {
    const auto at = row.first / (2 * nodes);
    const float* e = bounded_averages_.data();
    return lerp(gather(e, at), gather(e + 1, at), row.blend);
  }

  /// Terms averaged over directions.
  template <class F>
  SplitSumTerms<F> average(const AlbedoRow<F>& row) const {
    const auto at = row.first / nodes;
    const float* e = averages_.data();
    return {lerp(gather(e, at), gather(e + 2, at), row.blend),
            lerp(gather(e + 1, at), gather(e + 3, at), row.blend)};
  }

 private:
  static constexpr double least_bend = 1e-3;

  template <class F>
  static F column(const AlbedoRow<F>& row, F mu) {
    const F m = clamp(mu, F(0), F(1));
    return m * (F(1) + row.bend) / (m + row.bend) * F(nodes - 1);
  }

  std::vector<float> entries_;           // [roughness][mu]{scale, bias}
  std::vector<float> averages_;          // [roughness]{scale, bias}
  std::vector<float> edges_;             // [roughness][mu]
  std::vector<float> edge_averages_;     // [roughness]
  std::vector<float> bounded_averages_;  // [roughness]
  double greatest_ = 0;
};

}  // namespace kiln
