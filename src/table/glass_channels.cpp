// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "channel_lists.h"
#include "kiln/brdf/roughness.h"
#include "kiln/parallel/rows.h"
#include "kiln/table/glass_albedo.h"

namespace kiln {
namespace {

using enum Quantity;

QuadratureOrder order_for(Quality quality) {
  if (quality == Quality::Table) return glass_order;
  if (quality == Quality::Check) return {2 * glass_order.azimuths, 2 * glass_order.slopes};
  if (quality == Quality::Exact) return glass_reference_order;
  return {2 * glass_reference_order.azimuths, 2 * glass_reference_order.slopes};
}

// Of light that enters: reflected, transmitted; [ior][roughness][mu]. `Leaving` turns the index
// around.
template <bool Leaving>
std::vector<std::vector<double>> make_terms(TableContext& context) {
  const auto& mus = context.grid.of(Mu);
  const auto& roughnesses = context.grid.of(Roughness);
  const auto& iors = context.grid.of(Ior);
  const QuadratureOrder order = order_for(context.lobes.quality());
  const size_t rows = roughnesses.size() * iors.size();
  std::vector<std::vector<double>> planes(2, std::vector<double>(rows * mus.size()));
  for_rows(static_cast<int>(rows), [&](int row) {
    const double alpha = to_alpha(roughnesses[row % roughnesses.size()]);
    const double ior = std::max(iors[row / roughnesses.size()], 1 + 1e-6);
    for (size_t i = 0; i < mus.size(); ++i) {
      const GlassTerms terms = integrate_glass(mus[i], alpha, Leaving ? 1 / ior : ior, order);
      planes[0][row * mus.size() + i] = terms.reflected;
      planes[1][row * mus.size() + i] = terms.transmitted;
    }
  });
  return planes;
}

template <bool Leaving>
const std::vector<std::vector<double>>& terms_of(TableContext& context) {
  return shared_planes(context, Leaving ? "glass leaving" : "glass entering", make_terms<Leaving>);
}

template <bool Leaving, int Plane>
std::vector<double> fill(TableContext& context) {
  return terms_of<Leaving>(context)[Plane];
}

template <bool Leaving>
std::vector<double> fill_total(TableContext& context) {
  const auto& planes = terms_of<Leaving>(context);
  std::vector<double> total = planes[0];
  for (size_t i = 0; i < total.size(); ++i) total[i] += planes[1][i];
  return total;
}

}  // namespace

void add_glass_channels(std::vector<ChannelFacts>& list) {
  const std::vector<Quantity> solid = {Mu, Roughness, Ior};
  const auto add = [&](const char* name, const char* meaning,
                       std::vector<double> (*fill)(TableContext&)) {
    list.push_back({name, {}, meaning, solid, fill});
  };
  add("enter-reflected", "entering: share of energy reflected", fill<false, 0>);
  add("enter-transmitted", "entering: share of energy let through", fill<false, 1>);
  add("enter-total", "entering: reflected and let through", fill_total<false>);
  add("leave-reflected", "leaving: share of energy reflected", fill<true, 0>);
  add("leave-transmitted", "leaving: share of energy let through", fill<true, 1>);
  add("leave-total", "leaving: reflected and let through", fill_total<true>);
}

}  // namespace kiln
