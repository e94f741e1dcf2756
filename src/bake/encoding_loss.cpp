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

/// @param weights  solid angles of texels; empty: none are weighed
Sums sums_of(const Layers& image, const Layers& held, const Held& range,
             const std::vector<double>& weights) {
  Sums sums;
  for (int y = 0; y < image.size.height; ++y) {
    Sums row;
    const size_t first = static_cast<size_t>(y) * static_cast<size_t>(image.size.width);
    for (int x = 0; x < image.size.width; ++x) {
      const double weight = weights.empty() ? 0.0 : weights[first + static_cast<size_t>(x)];
      for (size_t c = 0; c < image.layers.size(); ++c) {
        add_value(image.layers[c].plane.at(x, y), held.layers[c].plane.at(x, y), range, weight,
                  row);
      }
    }
    sums.add(row);
  }
  return sums;
}

}  // namespace

EncodingLoss measure_encoding(const std::vector<std::vector<Layers>>& levels,
                              const SphereGrid& first, const std::string& pixel_type, double mean,
                              const Coded& coded) {
  const Held range = held_by(pixel_type, coded);
  const std::vector<double> weights = solid_angles(first);
  std::vector<const Layers*> images;
  for (const auto& level : levels) {
    for (const Layers& image : level) images.push_back(&image);
  }
  const size_t of_level = levels.front().size();
  std::vector<Sums> found(images.size());
  for_rows(static_cast<int>(images.size()), [&](int i) {
    const auto at = static_cast<size_t>(i);
    found[at] = sums_of(*images[at], coded(*images[at], pixel_type), range,
                        at < of_level ? weights : std::vector<double>{});
  });
  Sums all, of_first;
  double count = 0;
  for (size_t i = 0; i < images.size(); ++i) {
    all.add(found[i]);
    if (i < of_level) of_first.add(found[i]);
    count +=
        static_cast<double>(area(images[i]->size)) * static_cast<double>(images[i]->layers.size());
  }
  const double scale = 1 / std::max(std::abs(mean), 1e-30);
  return {std::sqrt(all.squares / std::max(count, 1.0)) * scale, all.greatest * scale,
          static_cast<long long>(all.clamped),
          of_first.power != 0 ? of_first.lost_power / of_first.power : 0};
}

}  // namespace kiln
