// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "kiln/light/source.h"
#include "kiln/parallel/rows.h"
#include "source_rows.h"
#include "sphere_texels.h"

namespace kiln {
namespace {

/// Sines and cosines of azimuths across an image.
struct Azimuths {
  std::vector<double> sine, cosine;

  explicit Azimuths(int count) {
    for (int i = 0; i < count; ++i) {
      const double azimuth_rad = 2 * pi * ((i + 0.5) / count - 0.5);
      sine.push_back(std::sin(azimuth_rad));
      cosine.push_back(std::cos(azimuth_rad));
    }
  }
};

}  // namespace

// A source finer than the finest picture is looked up at several points in each texel.
Layers picture_of(const SphereImage& source) {
  const SphereTexels texels(source);
  const int wanted = source_rows(source);
  const int height = std::min(wanted, most_rows), width = 2 * height;
  const int points = (wanted + height - 1) / height;
  const Azimuths azimuths(width * points);
  Layers picture = make_layers({width, height}, {"R", "G", "B"});
  for_rows(height, [&](int y) {
    for (int x = 0; x < width; ++x) {
      Vec3<double> sum{};
      for (int j = 0; j < points; ++j) {
        const double theta_rad = pi * (y * points + j + 0.5) / (height * points);
        const double sine = std::sin(theta_rad), cosine = std::cos(theta_rad);
        for (int i = 0; i < points; ++i) {
          const auto at = static_cast<size_t>(x * points + i);
          sum += texels.at({-azimuths.sine[at] * sine, cosine, azimuths.cosine[at] * sine});
        }
      }
      const Vec3<double> mean = sum * (1.0 / (points * points));
      picture.layers[0].plane.at(x, y) = static_cast<float>(mean.x);
      picture.layers[1].plane.at(x, y) = static_cast<float>(mean.y);
      picture.layers[2].plane.at(x, y) = static_cast<float>(mean.z);
    }
  });
  return picture;
}

}  // namespace kiln
