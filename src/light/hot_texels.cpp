// SPDX-License-Identifier: Apache-2.0
#include "hot_texels.h"

#include <cmath>

#include "kiln/image/projection.h"
#include "kiln/math/sums.h"
#include "kiln/math/wide.h"
#include "kiln/parallel/rows.h"

namespace kiln {
namespace {

bool any_above(const Plane& plane, int y, float limit) {
  constexpr int lanes = lane_count<WideFloat>;
  const float* row = plane.row(y);
  WideFloat most(0.0f);
  int x = 0;
  for (; x + lanes <= plane.width(); x += lanes) {
    most = max(most, abs(load_lanes<WideFloat>(row + x)));
  }
  bool found = any(most > WideFloat(limit));
  for (; x < plane.width(); ++x) found |= std::abs(row[x]) > limit;
  return found;
}

std::vector<HotTexel> hot_in_row(const ColorPlanes& latlong, const PowerLimit& limit, int y) {
  const double solid_angle = latlong_texel_solid_angle(latlong.size, y);
  std::array<float, 3> most;
  bool any = false;
  for (size_t c = 0; c < 3; ++c) {
    most[c] = limit.radiance(c, solid_angle);
    any = any || any_above(*latlong.planes[c], y, most[c]);
  }
  std::vector<HotTexel> hot;
  if (!any) return hot;
  for (int x = 0; x < latlong.size.width; ++x) {
    HotTexel texel{x, y, {}};
    bool is_hot = false;
    for (size_t c = 0; c < 3; ++c) {
      const float value = latlong.planes[c]->at(x, y);
      if (std::abs(value) <= most[c]) continue;
      texel.power[c] = value * solid_angle;
      is_hot = true;
    }
    if (is_hot) hot.push_back(texel);
  }
  return hot;
}

}  // namespace

PowerLimit share_of_power(const ColorPlanes& latlong, double share) {
  const auto sums = sum_rows(latlong.size.height, 3, [&](int y, std::vector<double>& row) {
    const double solid_angle = latlong_texel_solid_angle(latlong.size, y);
    for (size_t c = 0; c < 3; ++c) {
      row[c] = sum_of_magnitudes(latlong.planes[c]->texels_of_row(y)) * solid_angle;
    }
  });
  return {{share * sums[0], share * sums[1], share * sums[2]}};
}

std::vector<HotTexel> hot_texels(const ColorPlanes& latlong, const PowerLimit& limit) {
  std::vector<std::vector<HotTexel>> rows(static_cast<size_t>(latlong.size.height));
  for_rows(latlong.size.height,
           [&](int y) { rows[static_cast<size_t>(y)] = hot_in_row(latlong, limit, y); });
  std::vector<HotTexel> all;
  for (const auto& row : rows) all.insert(all.end(), row.begin(), row.end());
  return all;
}

}  // namespace kiln
