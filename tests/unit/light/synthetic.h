// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "kiln/image/layers.h"
#include "kiln/image/projection.h"
#include "kiln/math/hash.h"

namespace kiln::test {

inline Vec3<double> texel_direction(Size size, int x, int y) {
  return latlong_to_direction(Vec2<double>{(x + 0.5) / size.width, (y + 0.5) / size.height});
}

/// An environment whose texels hold a function of direction.
inline Layers environment_of(Size size,
                             const std::function<Vec3<double>(const Vec3<double>&)>& radiance) {
  Layers image = make_layers(size, {"R", "G", "B"});
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const Vec3<double> value = radiance(texel_direction(size, x, y));
      image.layers[0].plane.at(x, y) = static_cast<float>(value.x);
      image.layers[1].plane.at(x, y) = static_cast<float>(value.y);
      image.layers[2].plane.at(x, y) = static_cast<float>(value.z);
    }
  }
  return image;
}

inline Layers constant_environment(Size size, double value) {
  return environment_of(size, [=](const Vec3<double>&) {
    return Vec3<double>{value, value, value};
  });
}

/// A number in [0, 1) that depends on the seed and the index alone.
inline double random_unit(std::uint32_t seed, std::uint32_t index) {
  return combine_hash(mix_bits(seed + 1), index) * 0x1p-32;
}

/// A sky that brightens upward, a dark ground with noise, and a sun of one texel.
inline Layers sunny_environment(Size size, double sun) {
  Layers image = environment_of(size, [](const Vec3<double>& d) {
    const double sky = d.y > 0 ? 0.4 + 0.6 * d.y : 0.05;
    return Vec3<double>{sky, 0.9 * sky + 0.02 * d.x, 1.2 * sky + 0.02 * d.z};
  });
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const auto index = static_cast<std::uint32_t>(y * size.width + x);
      for (Layer& layer : image.layers) {
        layer.plane.at(x, y) *= static_cast<float>(0.5 + random_unit(7, index));
      }
    }
  }
  const int x = size.width * 5 / 8, y = size.height * 3 / 8;
  image.layers[0].plane.at(x, y) = static_cast<float>(sun);
  image.layers[1].plane.at(x, y) = static_cast<float>(0.9 * sun);
  image.layers[2].plane.at(x, y) = static_cast<float>(0.7 * sun);
  return image;
}

/// A unit direction that depends on the seed and the index alone, uniform over the sphere.
inline Vec3<double> random_direction(std::uint32_t seed, std::uint32_t index) {
  const double y = 1 - 2 * random_unit(seed, 2 * index);
  const double phi = 2 * pi * random_unit(seed, 2 * index + 1);
  const double s = std::sqrt(1 - y * y);
  return {s * std::cos(phi), y, s * std::sin(phi)};
}

}  // namespace kiln::test
