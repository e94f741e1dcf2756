// SPDX-License-Identifier: Apache-2.0
#include "channel_lists.h"
#include "kiln/parallel/rows.h"
#include "kiln/table/skin.h"

namespace kiln {
namespace {

using enum Quantity;

int order_for(Quality quality) {
  constexpr int orders[] = {32, 48, 64, 96};
  return orders[static_cast<int>(quality)];
}

// [colour][curvature][cosine]
std::vector<std::vector<double>> make_colors(TableContext& context) {
  const auto& cosines = context.grid.of(Cosine);
  const auto& curvatures = context.grid.of(Curvature);
  const int order = order_for(context.lobes.quality());
  std::vector<std::vector<double>> planes(3,
                                          std::vector<double>(cosines.size() * curvatures.size()));
  for_rows(static_cast<int>(curvatures.size()), [&](int j) {
    for (size_t i = 0; i < cosines.size(); ++i) {
      const Vec3<double> color = integrate_skin(cosines[i], curvatures[j], order);
      const size_t at = j * cosines.size() + i;
      planes[0][at] = color.x;
      planes[1][at] = color.y;
      planes[2][at] = color.z;
    }
  });
  return planes;
}

template <int Plane>
std::vector<double> fill(TableContext& context) {
  return shared_planes(context, "skin", make_colors)[Plane];
}

}  // namespace

void add_skin_channels(std::vector<ChannelFacts>& list) {
  const std::vector<Quantity> plane = {Cosine, Curvature};
  const char* meaning[] = {"red: irradiance of lit skin over that of the light", "green: likewise",
                           "blue: likewise"};
  list.push_back({"skin-red", {}, meaning[0], plane, fill<0>});
  list.push_back({"skin-green", {}, meaning[1], plane, fill<1>});
  list.push_back({"skin-blue", {}, meaning[2], plane, fill<2>});
}

}  // namespace kiln
