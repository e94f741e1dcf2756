// SPDX-License-Identifier: Apache-2.0
#include "glass_albedos.h"

#include "kiln/brdf/roughness.h"
#include "kiln/parallel/rows.h"
#include "kiln/table/glass_albedo.h"

namespace kiln {
namespace {

// Errs by less than the lookup.
constexpr QuadratureOrder coarse{12, 12};

}  // namespace

GlassAlbedos::GlassAlbedos(double ior) : entries_(2 * nodes * nodes) {
  for_rows(2 * nodes, [&](int row) {
    const double eta = row < nodes ? ior : 1 / ior;
    const double alpha = to_alpha(square(static_cast<double>(row % nodes) / (nodes - 1)));
    for (int i = 0; i < nodes; ++i) {
      const double mu = square(static_cast<double>(i) / (nodes - 1));
      entries_[static_cast<size_t>(row) * nodes + static_cast<size_t>(i)] =
          static_cast<float>(integrate_glass(mu, alpha, eta, coarse).total());
    }
  });
}

WideFloat GlassAlbedos::total(WideFloat mu, WideFloat roughness, MaskOf<WideFloat> inside) const {
  using F = WideFloat;
  const auto node = [](F x) { return sqrt(clamp(x, F(0.0f), F(1.0f))) * F(nodes - 1); };
  const F x = node(mu), y = node(roughness);
  const F left = min(floor(x), F(nodes - 2)), top = min(floor(y), F(nodes - 2));
  const F first = select(inside, F(nodes * nodes), F(0.0f));
  const auto at = to_index<F>(fma(top, F(nodes), first + left));
  const float* e = entries_.data();
  return lerp(lerp(gather(e, at), gather(e + 1, at), x - left),
              lerp(gather(e + nodes, at), gather(e + nodes + 1, at), x - left), y - top);
}

}  // namespace kiln
