// SPDX-License-Identifier: Apache-2.0
#include "channel_lists.h"
#include "kiln/parallel/rows.h"
#include "kiln/table/diffuse_albedo.h"

namespace kiln {
namespace {

using enum Quantity;

// Points between two kinks of the model.
int order_for(Quality quality) {
  constexpr int orders[] = {16, 24, 32, 40};
  return orders[static_cast<int>(quality)];
}

// In closed form where the model has one.
template <template <class> class Model>
double albedo_at(double mu, double roughness, int order) {
  if constexpr (Model<double>::closed_albedo) {
    return Model<double>{{1, 1, 1}, roughness}.albedo(mu).x;
  } else {
    return integrate_diffuse({std::string(Model<double>::name), roughness, 1}, mu, order);
  }
}

template <template <class> class Model>
std::vector<double> fill_model(TableContext& context) {
  const auto& mus = context.grid.of(Mu);
  const auto& roughnesses = context.grid.of(Roughness);
  const int order = order_for(context.lobes.quality());
  std::vector<double> values(mus.size() * roughnesses.size());
  for_rows(static_cast<int>(roughnesses.size()), [&](int j) {
    for (size_t i = 0; i < mus.size(); ++i) {
      values[j * mus.size() + i] = albedo_at<Model>(mus[i], roughnesses[j], order);
    }
  });
  return values;
}

// Unity divides Disney's diffuse by 1.03571, its greatest albedo seen from straight above, and
// stores what lies in [1/2, 3/2] less 1/2.
std::vector<double> fill_unity_disney(TableContext& context) {
  std::vector<double> values = fill_model<Burley>(context);
  for (double& value : values) value = value / 1.03571 - 0.5;
  return values;
}

}  // namespace

void add_diffuse_channels(std::vector<ChannelFacts>& list) {
  const std::vector<Quantity> plane = {Mu, Roughness};
  Diffuses::for_each([&]<template <class> class Model>() {
    const std::string name(Model<double>::name);
    list.push_back({"diffuse-" + name,
                    {name},
                    name + ": directional albedo of the white diffuse model",
                    plane,
                    fill_model<Model>});
  });
  list.push_back({"unity-disney",
                  {},
                  "disney: albedo of Burley's diffuse over 1.03571, less 1/2",
                  plane,
                  fill_unity_disney});
}

}  // namespace kiln
