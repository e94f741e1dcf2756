// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "image_folder.h"
#include "kiln/image/projection.h"
#include "kiln/io/texture_file.h"

namespace kiln::test {

/// A texture of distinct values: each level, face and channel begins elsewhere in the pattern.
inline Texture textured(Size size, size_t levels, size_t faces,
                        const std::vector<std::string>& names) {
  Texture texture;
  for (size_t l = 0; l < levels; ++l) {
    std::vector<Layers>& level = texture.levels.emplace_back();
    for (size_t f = 0; f < faces; ++f) {
      Layers face = pattern(size, names);
      for (Layer& layer : face.layers) {
        for (int y = 0; y < size.height; ++y) {
          for (int x = 0; x < size.width; ++x) {
            layer.plane.at(x, y) =
                layer.plane.at(x, y) * 3 + static_cast<float>(f) + 10 * static_cast<float>(l);
          }
        }
      }
      level.push_back(std::move(face));
    }
    size = {std::max(1, size.width / 2), std::max(1, size.height / 2)};
  }
  return texture;
}

inline Texture cube(int edge, size_t levels,
                    const std::vector<std::string>& names = {"R", "G", "B"}) {
  return textured({edge, edge}, levels, 6, names);
}

/// How many levels an edge has down to 1.
inline size_t all_levels(int edge) {
  size_t levels = 1;
  for (; edge > 1; edge /= 2) ++levels;
  return levels;
}

using Light = std::function<float(const Vec3<double>& direction, size_t channel)>;

/// A cube whose samples are at nodes: the outermost lie on the edges.
inline Texture cube_at_nodes(int edge, size_t levels, const Light& light) {
  Texture texture = cube(edge, levels);
  for (std::vector<Layers>& level : texture.levels) {
    for (size_t f = 0; f < 6; ++f) {
      const int n = level[f].size.width;
      for (int y = 0; y < n; ++y) {
        for (int x = 0; x < n; ++x) {
          const auto at = [n](int i) { return n == 1 ? 0.5 : i / (n - 1.0); };
          const Vec3<double> d =
              cube_to_direction(static_cast<CubeFace>(f), Vec2<double>{at(x), at(y)});
          const double length = std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z);
          for (size_t c = 0; c < 3; ++c) {
            level[f].layers[c].plane.at(x, y) =
                light({d.x / length, d.y / length, d.z / length}, c);
          }
        }
      }
    }
  }
  return texture;
}

/// A lat-long whose first column equals its last, and whose first and last row are the poles.
inline Texture latlong_at_nodes(int height, size_t levels, const Light& light) {
  Texture texture = textured({2 * height, height}, levels, 1, {"R", "G", "B"});
  for (std::vector<Layers>& level : texture.levels) {
    const Size size = level[0].size;
    for (int y = 0; y < size.height; ++y) {
      for (int x = 0; x < size.width; ++x) {
        const Vec2<double> uv{size.width == 1 ? 0.5 : x / (size.width - 1.0),
                              size.height == 1 ? 0.5 : y / (size.height - 1.0)};
        for (size_t c = 0; c < 3; ++c) {
          level[0].layers[c].plane.at(x, y) = light(latlong_to_direction(uv), c);
        }
      }
    }
  }
  return texture;
}

/// Smooth, positive, and different in every direction and channel.
inline float smooth_light(const Vec3<double>& d, size_t channel) {
  const double axis = channel == 0 ? d.x : channel == 1 ? d.y : d.z;
  return static_cast<float>(2 + axis + 0.5 * d.x * d.y - 0.25 * d.z * d.x);
}

/// The greatest difference of two images in the layers of the first.
inline double greatest_difference(const Layers& a, const Layers& b) {
  double worst = 0;
  for (const Layer& layer : a.layers) {
    const Plane* other = b.find(layer.name);
    if (other == nullptr || other->size() != layer.plane.size()) return 1e30;
    for (int y = 0; y < a.size.height; ++y) {
      for (int x = 0; x < a.size.width; ++x) {
        worst = std::max(worst, std::abs(double(layer.plane.at(x, y)) - other->at(x, y)));
      }
    }
  }
  return worst;
}

/// The greatest difference of two texels that meet across an edge of the cube, in the first
/// channel.
inline double greatest_seam(const std::vector<Layers>& faces) {
  const int n = faces[0].size.width;
  const auto inside = [n](int i) { return std::clamp(i, 0, n - 1); };
  double worst = 0;
  for (size_t f = 0; f < 6; ++f) {
    for (int i = 0; i < n; ++i) {
      for (const auto& [x, y] : {std::pair{-1, i}, {n, i}, {i, -1}, {i, n}}) {
        const CubePoint beyond = direction_to_cube(cube_to_direction(
            static_cast<CubeFace>(f), Vec2<double>{(x + 0.5) / n, (y + 0.5) / n}));
        const Layers& other = faces[static_cast<size_t>(beyond.face)];
        const float here = faces[f].layers[0].plane.at(inside(x), inside(y));
        const float there = other.layers[0].plane.at(inside(static_cast<int>(beyond.uv.x * n)),
                                                     inside(static_cast<int>(beyond.uv.y * n)));
        worst = std::max<double>(worst, std::abs(here - there));
      }
    }
  }
  return worst;
}

/// The greatest difference of two neighbours within a face, in the first channel.
inline double greatest_step(const std::vector<Layers>& faces) {
  double worst = 0;
  for (const Layers& face : faces) {
    const Plane& plane = face.layers[0].plane;
    for (int y = 0; y + 1 < plane.height(); ++y) {
      for (int x = 0; x + 1 < plane.width(); ++x) {
        worst = std::max<double>({worst, std::abs(plane.at(x, y) - plane.at(x + 1, y)),
                                  std::abs(plane.at(x, y) - plane.at(x, y + 1))});
      }
    }
  }
  return worst;
}

}  // namespace kiln::test
