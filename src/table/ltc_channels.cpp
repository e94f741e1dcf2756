// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <numeric>

#include "channel_lists.h"
#include "kiln/brdf/roughness.h"
#include "kiln/brdf/surface.h"
#include "kiln/parallel/rows.h"
#include "kiln/table/ltc.h"
#include "lobe_kernels.h"

namespace kiln {
namespace {

using enum Quantity;

LtcLobe lobe_of(const Lobe& lobe) {
  const double shape = shape_of(lobe.distribution, lobe.shape);
  LtcLobe found;
  with_lobe(lobe.distribution, lobe.masking,
            [&]<template <class> class Distribution, template <class> class Masking>() {
              found = [shape](double alpha, const Vec3<double>& wo, const Vec3<double>& wi) {
                const auto distribution = Distribution<double>::make(alpha, alpha, shape);
                const Vec3<double> wm = half_vector(wo, wi);
                return distribution.D(wm) * Masking<double>::visibility(distribution, wo, wi, wm) *
                       wi.z;
              };
            });
  return found;
}

// From straight above to grazing, each fit starting from the one before.
std::vector<size_t> steep_first(const std::vector<double>& mus) {
  std::vector<size_t> order(mus.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) { return mus[a] > mus[b]; });
  return order;
}

// m11, m31, m13, m33, error; [roughness][mu]
std::vector<std::vector<double>> make_fits(TableContext& context) {
  const auto& mus = context.grid.of(Mu);
  const auto& roughnesses = context.grid.of(Roughness);
  const LtcLobe lobe = lobe_of(context.models.lobe);
  const std::vector<size_t> order = steep_first(mus);
  std::vector<std::vector<double>> planes(5, std::vector<double>(mus.size() * roughnesses.size()));
  for_rows(static_cast<int>(roughnesses.size()), [&](int j) {
    const double alpha = to_alpha(roughnesses[j]);
    LtcCell cell{1 / alpha, 0, 0, 1, 0};
    for (const size_t i : order) {
      cell = fit_ltc_cell(std::max(mus[i], std::cos(1.57)), alpha, lobe, cell);
      const double values[] = {cell.m11, cell.m31, cell.m13, cell.m33, cell.error};
      for (int k = 0; k < 5; ++k) planes[k][j * mus.size() + i] = values[k];
    }
  });
  return planes;
}

template <int Plane>
std::vector<double> fill(TableContext& context) {
  return shared_planes(context, "ltc", make_fits)[Plane];
}

// The published layout keeps this in the same texture, over quantities of its own: the cosine of
// the sphere runs along x as 2 u - 1, sin^2 of its angular radius along y.
std::vector<double> fill_sphere(TableContext& context) {
  std::vector<double> values;
  for (const double roughness : context.grid.of(Roughness)) {
    for (const double mu : context.grid.of(Mu)) {
      values.push_back(sphere_form_factor(2 * roughness - 1, std::sqrt(std::max(1 - mu, 0.0))));
    }
  }
  return values;
}

}  // namespace

void add_ltc_channels(std::vector<ChannelFacts>& list) {
  const std::vector<Quantity> plane = {Mu, Roughness};
  list.push_back(
      {"ltc-m11", {}, "m11: of the inverse matrix whose middle is 1", plane, fill<0>, true});
  list.push_back({"ltc-m31", {}, "m31: of the inverse matrix", plane, fill<1>, true});
  list.push_back({"ltc-m13", {}, "m13: of the inverse matrix", plane, fill<2>, true});
  list.push_back({"ltc-m33", {}, "m33: of the inverse matrix", plane, fill<3>, true});
  list.push_back({"ltc-error",
                  {},
                  "error: share of light that the fit sends elsewhere",
                  plane,
                  fill<4>,
                  true});
  list.push_back(
      {"sphere",
       {},
       "sphere: form factor of a sphere cut by the horizon; its cosine 2 u - 1 along the "
       "roughness axis, sin^2 of its radius along sqrt(1 - n.v)",
       plane,
       fill_sphere});
}

}  // namespace kiln
