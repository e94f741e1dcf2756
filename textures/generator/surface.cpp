// SPDX-License-Identifier: Apache-2.0
#include "surface.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "kiln/image/layers.h"
#include "kiln/io/image_file.h"
#include "kiln/parallel/rows.h"

namespace kiln::textures {
namespace {

/// Every property of a material as a plane.
struct Painted {
  std::array<Plane, 3> color, specular, normal;  ///< normal: OpenGL, unit
  Plane level, roughness, metallic, height, occlusion;
};

constexpr Size tile{tile_size, tile_size};
constexpr int grid = 2;  ///< points per texel and axis; their mean keeps edges free of steps

Spot mean_spot(const Set& set, int x, int y) {
  Spot sum{{}, {}, 0, 0, 0, 0};
  constexpr double share = 1.0 / (grid * grid);
  for (int i = 0; i < grid * grid; ++i) {
    const double u = (x + (i % grid + 0.5) / grid) / tile_size;
    const double v = (y + (i / grid + 0.5) / grid) / tile_size;
    const Spot spot = set.spot({u, v});
    sum.color += spot.color * share;
    sum.specular += spot.specular * share;
    sum.level += spot.level * share;
    sum.roughness += spot.roughness * share;
    sum.metallic += spot.metallic * share;
    sum.height += spot.height * share;
  }
  return sum;
}

float stored(double value) { return static_cast<float>(std::clamp(value, 0.0, 1.0)); }

void put(std::array<Plane, 3>& planes, int x, int y, const Color& color) {
  planes[0].at(x, y) = stored(color.x);
  planes[1].at(x, y) = stored(color.y);
  planes[2].at(x, y) = stored(color.z);
}

int beside(int i, int step) { return (i + step + tile_size) % tile_size; }

/// Mean of the heights within `reach` texels, around the borders of the tile; one axis at a time.
Plane blurred(const Plane& height, int reach) {
  Plane across(tile), both(tile);
  const double share = 1.0 / (2 * reach + 1);
  for_rows(tile_size, [&](int y) {
    for (int x = 0; x < tile_size; ++x) {
      double sum = 0;
      for (int k = -reach; k <= reach; ++k) sum += height.at(beside(x, k), y);
      across.at(x, y) = static_cast<float>(sum * share);
    }
  });
  for_rows(tile_size, [&](int y) {
    for (int x = 0; x < tile_size; ++x) {
      double sum = 0;
      for (int k = -reach; k <= reach; ++k) sum += across.at(x, beside(y, k));
      both.at(x, y) = static_cast<float>(sum * share);
    }
  });
  return both;
}

/// Darkness of hollows: how far a texel lies below the mean of its surroundings, at two reaches.
Plane occlusion_of(const Plane& height, double relief) {
  const Plane near = blurred(height, 3), far = blurred(height, 10);
  Plane occlusion(tile);
  for_rows(tile_size, [&](int y) {
    for (int x = 0; x < tile_size; ++x) {
      const double h = height.at(x, y);
      const double hollow =
          std::max(near.at(x, y) - h, 0.0) / 3 + std::max(far.at(x, y) - h, 0.0) / 10;
      occlusion.at(x, y) = stored(1 / (1 + 1.5 * relief * hollow));
    }
  });
  return occlusion;
}

/// Unit normals of the heights by central differences around the borders. +Y is up, rows go down:
/// n ~ (-dh/dx, +dh/drow, 1).
std::array<Plane, 3> normals_of(const Plane& height, double relief) {
  std::array<Plane, 3> normal{Plane(tile), Plane(tile), Plane(tile)};
  for_rows(tile_size, [&](int y) {
    for (int x = 0; x < tile_size; ++x) {
      const double dx = relief * (height.at(beside(x, 1), y) - height.at(beside(x, -1), y)) / 2;
      const double dy = relief * (height.at(x, beside(y, 1)) - height.at(x, beside(y, -1))) / 2;
      const double scale = 1 / std::sqrt(dx * dx + dy * dy + 1);
      normal[0].at(x, y) = static_cast<float>(-dx * scale);
      normal[1].at(x, y) = static_cast<float>(dy * scale);
      normal[2].at(x, y) = static_cast<float>(scale);
    }
  });
  return normal;
}

Painted paint(const Set& set) {
  Painted painted;
  for (auto* planes : {&painted.color, &painted.specular}) planes->fill(Plane(tile));
  for (Plane* plane : {&painted.level, &painted.roughness, &painted.metallic, &painted.height}) {
    *plane = Plane(tile);
  }
  for_rows(tile_size, [&](int y) {
    for (int x = 0; x < tile_size; ++x) {
      const Spot spot = mean_spot(set, x, y);
      put(painted.color, x, y, spot.color);
      put(painted.specular, x, y, spot.specular);
      painted.level.at(x, y) = stored(spot.level);
      painted.roughness.at(x, y) = stored(spot.roughness);
      painted.metallic.at(x, y) = stored(spot.metallic);
      painted.height.at(x, y) = stored(spot.height);
    }
  });
  painted.normal = normals_of(painted.height, set.relief);
  painted.occlusion = occlusion_of(painted.height, set.relief);
  return painted;
}

/// @source IEC 61966-2-1
float srgb_encoded(float linear) {
  const double x = linear;
  return static_cast<float>(x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055);
}

Plane mapped(const Plane& plane, const std::function<float(float)>& to) {
  Plane result(plane.size());
  for_rows(plane.height(), [&](int y) {
    for (int x = 0; x < plane.width(); ++x) result.at(x, y) = to(plane.at(x, y));
  });
  return result;
}

Layers grey(const Plane& plane) { return {tile, {{"Y", plane}}}; }

Layers rgb(const Plane& red, const Plane& green, const Plane& blue) {
  return {tile, {{"R", red}, {"G", green}, {"B", blue}}};
}

Layers color_map(const std::array<Plane, 3>& c) {
  return rgb(mapped(c[0], srgb_encoded), mapped(c[1], srgb_encoded), mapped(c[2], srgb_encoded));
}

Layers normal_map(const std::array<Plane, 3>& n, float green_sign) {
  const auto up = [](float v) { return 0.5f * v + 0.5f; };
  return rgb(mapped(n[0], up), mapped(n[1], [=](float v) { return up(green_sign * v); }),
             mapped(n[2], up));
}

Layers image_of(const Painted& painted, Map map) {
  switch (map) {
    case Map::Albedo:
      return color_map(painted.color);
    case Map::SpecularColor:
      return color_map(painted.specular);
    case Map::SpecularLevel:
      return grey(painted.level);
    case Map::Roughness:
      return grey(painted.roughness);
    case Map::Glossiness:
      return grey(mapped(painted.roughness, [](float r) { return 1 - r; }));
    case Map::Metallic:
      return grey(painted.metallic);
    case Map::Occlusion:
      return grey(painted.occlusion);
    case Map::OcclusionRoughnessMetallic:
      return rgb(painted.occlusion, painted.roughness, painted.metallic);
    case Map::NormalOpenGl:
      return normal_map(painted.normal, 1);
    case Map::NormalDirectX:
      return normal_map(painted.normal, -1);
    case Map::Height:
      return grey(painted.height);
  }
  return {};
}

}  // namespace

void write_set(const Set& set, const std::filesystem::path& folder) {
  const Painted painted = paint(set);
  for (const MapFile& file : set.files) {
    const PixelType type = file.map == Map::Height ? PixelType::Uint16 : PixelType::Uint8;
    write_image(folder / set.folder / file.name, image_of(painted, file.map),
                {.type = type, .attributes = {}});
  }
}

}  // namespace kiln::textures
