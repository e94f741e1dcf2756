// SPDX-License-Identifier: Apache-2.0
#include "kiln/light/dominant_light.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "color_planes.h"
#include "kiln/image/projection.h"
#include "kiln/parallel/rows.h"

namespace kiln {
namespace {

constexpr double widest_light = 0.5;  // [sr]

struct Texel {
  int x, y;
};

Texel brightest(const ColorPlanes& latlong) {
  std::vector<double> most(static_cast<size_t>(latlong.size.height), -INFINITY);
  for_rows(latlong.size.height, [&](int y) {
    double& of_row = most[static_cast<size_t>(y)];
    for (int x = 0; x < latlong.size.width; ++x) {
      of_row = std::max(of_row, luminance(latlong.at(x, y)));
    }
  });
  const auto row = std::max_element(most.begin(), most.end());
  Texel texel{0, static_cast<int>(row - most.begin())};
  while (texel.x + 1 < latlong.size.width && luminance(latlong.at(texel.x, texel.y)) < *row) {
    ++texel.x;
  }
  return texel;
}

/// Sums over the texels of a light.
struct Sums {
  double solid_angle = 0;
  Vec3<double> power, toward;
};

void add(const ColorPlanes& latlong, const Texel& at, Sums& sums) {
  const double solid_angle = latlong_texel_solid_angle(latlong.size, at.y);
  const Vec3<double> power = latlong.at(at.x, at.y) * solid_angle;
  const Vec2<double> uv{(at.x + 0.5) / latlong.size.width, (at.y + 0.5) / latlong.size.height};
  sums.solid_angle += solid_angle;
  sums.power += power;
  sums.toward += latlong_to_direction(uv) * luminance(power);
}

}  // namespace

std::optional<DominantLight> dominant_light(const Layers& latlong) {
  const ColorPlanes source = color_planes(latlong);
  const auto [width, height] = source.size;
  const Texel best = brightest(source);
  const double least = 0.5 * luminance(source.at(best.x, best.y));
  if (!(least > 0)) return std::nullopt;
  std::vector<bool> seen(static_cast<size_t>(area(source.size)));
  std::vector<Texel> open;
  const auto visit = [&, width = width, height = height](int x, int y) {
    if (y < 0 || y >= height) return;
    x = (x + width) % width;
    const size_t index =
        static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x);
    if (seen[index] || luminance(source.at(x, y)) < least) return;
    seen[index] = true;
    open.push_back({x, y});
  };
  Sums sums;
  visit(best.x, best.y);
  while (!open.empty()) {
    const Texel at = open.back();
    open.pop_back();
    add(source, at, sums);
    if (sums.solid_angle > widest_light) return std::nullopt;
    visit(at.x + 1, at.y);
    visit(at.x - 1, at.y);
    visit(at.x, at.y + 1);
    visit(at.x, at.y - 1);
  }
  const double along = length(sums.toward);
  const Vec3<double> irradiance = sums.power * (along / luminance(sums.power));
  return DominantLight{sums.toward * (1 / along), sums.solid_angle,
                       sums.power * (1 / sums.solid_angle), irradiance};
}

}  // namespace kiln
