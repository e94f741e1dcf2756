// SPDX-License-Identifier: Apache-2.0
#include "encoding_loss.h"

#include <cmath>
#include <limits>

#include "kiln/parallel/rows.h"

namespace kiln {
namespace {

/// The least and the greatest number of a type.
struct Held {
  float least, most;
};

Held held_by(const std::string& pixel_type, const Coded& coded) {
  Layers probe = make_layers({2, 1}, {"R", "G", "B"});
  for (Layer& layer : probe.layers) {
    layer.plane.at(0, 0) = std::numeric_limits<float>::lowest();
    layer.plane.at(1, 0) = std::numeric_limits<float>::max();
  }
  const Layers held = coded(probe, pixel_type);
  return {held.layers[0].plane.at(0, 0), held.layers[2].plane.at(1, 0)};
}

// Of a face or an image, as good as exact for the sum over one.
double solid_angle_of(const SphereGrid& grid, int x, int y) {
  const Size size = grid.image_size();
  if (grid.layout == SphereLayout::Cube) return cube_texel_solid_angle(size.width, x, y);
  if (grid.layout == SphereLayout::LatLong) return latlong_texel_solid_angle(size, y);
  return octahedral_texel_solid_angle(size.width, x, y);
}

/// Sums over the values of an image.
struct Sums {
  double squares = 0, greatest = 0, clamped = 0;
  double power = 0, lost_power = 0;  ///< weighed by solid angle

  void add(const Sums& other) {
    squares += other.squares;
    greatest = std::max(greatest, other.greatest);
    clamped += other.clamped;
    power += other.power;
    lost_power += other.lost_power;
  }
};

void add_value(float is, float has, const Held& range, double solid_angle, Sums& sums) {
  const double error = static_cast<double>(has) - is;
  const bool beyond = is < range.least || is > range.most;
  sums.squares += error * error;
  sums.greatest = std::max(sums.greatest, std::abs(error));
  sums.clamped += beyond ? 1 : 0;
  sums.power += is * solid_angle;
  sums.lost_power -= beyond ? error * solid_angle : 0;
}

Sums sums_of(const Layers& image, const Layers& held, const Held& range, const SphereGrid& grid) {
  std::vector<Sums> rows(static_cast<size_t>(image.size.height));
  for_rows(image.size.height, [&](int y) {
    Sums& row = rows[static_cast<size_t>(y)];
    for (int x = 0; x < image.size.width; ++x) {
      const double solid_angle = solid_angle_of(grid, x, y);
      for (size_t c = 0; c < image.layers.size(); ++c) {
        add_value(image.layers[c].plane.at(x, y), held.layers[c].plane.at(x, y), range, solid_angle,
                  row);
      }
    }
  });
  Sums sums;
  for (const Sums& row : rows) sums.add(row);
  return sums;
}

}  // namespace

EncodingLoss measure_encoding(const std::vector<std::vector<Layers>>& levels,
                              const SphereGrid& first, const std::string& pixel_type, double mean,
                              const Coded& coded) {
  const Held range = held_by(pixel_type, coded);
  Sums all, of_first;
  double count = 0;
  for (size_t level = 0; level < levels.size(); ++level) {
    SphereGrid grid = first;
    grid.size = std::max(1, first.size >> level);
    for (const Layers& image : levels[level]) {
      const Sums found = sums_of(image, coded(image, pixel_type), range, grid);
      all.add(found);
      if (level == 0) of_first.add(found);
      count += static_cast<double>(area(image.size)) * static_cast<double>(image.layers.size());
    }
  }
  const double scale = 1 / std::max(std::abs(mean), 1e-30);
  return {std::sqrt(all.squares / std::max(count, 1.0)) * scale, all.greatest * scale,
          static_cast<long long>(all.clamped),
          of_first.power != 0 ? of_first.lost_power / of_first.power : 0};
}

}  // namespace kiln
