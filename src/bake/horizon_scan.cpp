// SPDX-License-Identifier: Apache-2.0
#include "horizon_scan.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "kiln/math/vec.h"
#include "kiln/math/wide.h"

namespace kiln {
namespace {

using F = WideFloat;
constexpr int lanes = lane_count<F>;

// Distances that are looked at [texel]: each of the first, then farther and farther apart.
std::vector<double> distances(double radius) {
  constexpr double all_up_to = 16, growth = 1.1;
  std::vector<double> result;
  for (double d = 1; d <= radius; d = d < all_up_to ? d + 1 : d * growth) result.push_back(d);
  return result;
}

// What a surface receives between two angles from the vertical, its own normal at `tilt`: the
// integral of the cosine over that arc, doubled back into the third dimension.
F received(F angle, F tilt) {
  const F twice = angle + angle;
  return F(0.25f) * (cos(tilt) - cos(twice - tilt) + twice * sin(tilt));
}

}  // namespace

HorizonScan::HorizonScan(const Plane& height, const Options& options)
    : size_(height.size()), scale_(static_cast<float>(options.height_scale)) {
  const double radius = std::min<double>(options.radius, std::min(size_.width, size_.height));
  border_ = static_cast<int>(std::ceil(radius)) + 1;
  heights_ = Plane({size_.width + 2 * border_ + lanes, size_.height});
  for (int y = 0; y < size_.height; ++y) {
    const float* from = height.row(y);
    float* to = heights_.row(y);
    for (int x = 0; x < heights_.width(); ++x) {
      to[x] = from[((x - border_) % size_.width + size_.width) % size_.width];
    }
  }
  for (int i = 0; i < options.directions; ++i) {
    const double angle_rad = 2 * pi * i / options.directions;
    Direction direction{std::cos(angle_rad), std::sin(angle_rad), {}};
    for (const double distance : distances(radius)) {
      const auto dx = static_cast<int>(std::lround(distance * direction.x));
      const auto dy = static_cast<int>(std::lround(distance * direction.y));
      const double length = std::hypot(dx, dy);
      direction.steps.push_back({dx, dy, static_cast<float>(options.height_scale / length)});
    }
    directions_.push_back(std::move(direction));
  }
}

// Heights of the texels from x on, in a row that may lie beyond the map.
const float* HorizonScan::around(int x, int y) const {
  const int row = (y % size_.height + size_.height) % size_.height;
  return heights_.row(row) + border_ + x;
}

void HorizonScan::visibility(int y, float* row) const {
  const size_t planes = directions_.size() / 2;
  for (int x = 0; x < size_.width; x += lanes) {
    const F here = load_lanes<F>(around(x, y));
    const auto slope_to = [&](const Direction& direction) {
      F slope(-1e9f);
      for (const Step& step : direction.steps) {
        const F there = load_lanes<F>(around(x + step.dx, y + step.dy));
        slope = max(slope, (there - here) * F(step.inverse_distance));
      }
      return slope;
    };
    const F half_scale(0.5f * scale_);
    const F down_x =
        (load_lanes<F>(around(x - 1, y)) - load_lanes<F>(around(x + 1, y))) * half_scale;
    const F down_y =
        (load_lanes<F>(around(x, y - 1)) - load_lanes<F>(around(x, y + 1))) * half_scale;
    const F inverse = F(1.0f) / sqrt(fma(down_x, down_x, fma(down_y, down_y, F(1.0f))));
    F sum(0.0f);
    for (size_t i = 0; i < planes; ++i) {
      const Direction& ahead = directions_[i];
      const F along =
          (down_x * F(static_cast<float>(ahead.x)) + down_y * F(static_cast<float>(ahead.y)));
      const F tilt = atan(along);  // of the normal, toward `ahead`
      const F length = inverse * sqrt(fma(along, along, F(1.0f)));
      const F quarter(static_cast<float>(0.5 * pi));
      const F front = min(quarter - atan(slope_to(ahead)), tilt + quarter);
      const F back = max(atan(slope_to(directions_[i + planes])) - quarter, tilt - quarter);
      sum += length * (received(front, tilt) + received(back, tilt));
    }
    store_lanes(row + x, clamp(sum / F(static_cast<float>(planes)), F(0.0f), F(1.0f)));
  }
}

}  // namespace kiln
