// SPDX-License-Identifier: Apache-2.0
#include "preview_difference.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "kiln/math/vec.h"
#include "lettering.h"
#include "sheet.h"

namespace kiln {
namespace {

using Color = Vec3<float>;

constexpr double share_within = 0.995;
const Color none{0.96f, 0.96f, 0.95f}, dark_ink{0.12f, 0.12f, 0.13f};
const Color above_half{0.93f, 0.55f, 0.38f}, above_full{0.64f, 0.06f, 0.12f};
const Color below_half{0.45f, 0.66f, 0.88f}, below_full{0.05f, 0.19f, 0.55f};

Color blend(const Color& a, const Color& b, float t) { return a * (1 - t) + b * t; }

// share in [-1, 1]; NaN is black.
Color color_of(float share) {
  if (!(share == share)) return {0, 0, 0};
  const float t = std::min(std::abs(share), 1.0f);
  const Color &half = share < 0 ? below_half : above_half,
              &full = share < 0 ? below_full : above_full;
  return t < 0.5f ? blend(none, half, 2 * t) : blend(half, full, 2 * t - 1);
}

float luminance_at(const Layers& image, int x, int y) {
  const auto at = [&](size_t c) { return image.layers[c].plane.at(x, y); };
  return luminance(Color{at(0), at(1), at(2)});
}

// The least of 1, 2, 5 times powers of ten that is not below it.
double round_up(double value) {
  if (!(value > 1e-30)) return 1e-3;
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  for (const double step : {1.0, 2.0, 5.0}) {
    if (step * power >= value * (1 - 1e-9)) return step * power;
  }
  return 10 * power;
}

void put(Layers& image, int x, int y, const Color& color) {
  image.layers[0].plane.at(x, y) = color.x;
  image.layers[1].plane.at(x, y) = color.y;
  image.layers[2].plane.at(x, y) = color.z;
}

struct Bar {
  int left, right, top, bottom;
};

void draw_bar(Layers& strip, const Bar& bar) {
  for (int y = bar.top; y < bar.bottom; ++y) {
    for (int x = bar.left; x < bar.right; ++x) {
      const float u =
          (static_cast<float>(x - bar.left) + 0.5f) / static_cast<float>(bar.right - bar.left);
      const bool edge = x == bar.left || x == bar.right - 1 || y == bar.top || y == bar.bottom - 1;
      put(strip, x, y, edge ? dark_ink : color_of(2 * u - 1));
    }
  }
}

}  // namespace

double difference_scale(const std::vector<const Layers*>& differences) {
  std::vector<float> sizes;
  for (const Layers* image : differences) {
    const Plane& alpha = *image->find("A");
    for (int y = 0; y < image->size.height; ++y) {
      for (int x = 0; x < image->size.width; ++x) {
        const float size = std::abs(luminance_at(*image, x, y));
        if (alpha.at(x, y) > 0 && std::isfinite(size)) sizes.push_back(size);
      }
    }
  }
  if (sizes.empty()) return round_up(0);
  const auto last = static_cast<double>(sizes.size() - 1);
  const auto at = sizes.begin() + static_cast<std::ptrdiff_t>(share_within * last);
  std::nth_element(sizes.begin(), at, sizes.end());
  return round_up(*at);
}

Layers paint_difference(const Layers& difference, double scale) {
  Layers painted = make_layers(difference.size, {"R", "G", "B", "A"});
  painted.layers[3].plane = *difference.find("A");
  for (int y = 0; y < painted.size.height; ++y) {
    for (int x = 0; x < painted.size.width; ++x) {
      const auto share = static_cast<float>(luminance_at(difference, x, y) / scale);
      put(painted, x, y, color_of(share));
    }
  }
  return painted;
}

Layers difference_legend(Size size, double scale) {
  Layers strip = make_sheet(size, none);
  const double unit = size.height / 64.0;
  const double height = 13 * unit;
  const int margin = static_cast<int>(0.08 * size.width);
  const Bar bar{margin, size.width - margin, static_cast<int>(10 * unit),
                std::max(static_cast<int>(30 * unit), static_cast<int>(10 * unit) + 2)};
  draw_bar(strip, bar);
  const Lettering lettering{height, dark_ink};
  const double baseline = 51 * unit;
  std::vector<std::string> labels = {fmt::format("-{:g}", scale), "0", fmt::format("+{:g}", scale)};
  double taken = 0;
  for (const std::string& label : labels) taken += text_width(label, height) + 2 * height;
  if (taken > size.width) return strip;
  for (size_t i = 0; i < 3; ++i) {
    const double center = bar.left + 0.5 * static_cast<double>(i) * (bar.right - bar.left);
    const double width = text_width(labels[i], height);
    const double left = std::clamp(center - 0.5 * width, unit * 4, size.width - width - unit * 4);
    draw_text(strip, {left, baseline}, labels[i], lettering);
  }
  const double quarter = 0.25 * (bar.right - bar.left);
  const double room = quarter - text_width(labels[2], height) - height;
  for (const auto& [text, center] : {std::pair<const char*, double>{"too dark", bar.left + quarter},
                                     {"too bright", bar.right - quarter}}) {
    const double width = text_width(text, height);
    if (width < 2 * room) draw_text(strip, {center - 0.5 * width, baseline}, text, lettering);
  }
  return strip;
}

Layers difference_view(const Layers& difference) {
  const double scale = difference_scale({&difference});
  const Size size = difference.size;
  const int strip = std::clamp(size.width / 8, 8, 64);
  Layers view = make_layers({size.width, size.height + strip}, {"R", "G", "B", "A"});
  place(paint_difference(difference, scale), {0, 0}, view);
  place(difference_legend({size.width, strip}, scale), {0, size.height}, view);
  return view;
}

std::vector<std::pair<std::string, double>> difference_figures(const Layers& difference,
                                                               double mean_radiance) {
  const Plane& alpha = *difference.find("A");
  double sum = 0, squares = 0, greatest = 0, count = 0;
  for (size_t c = 0; c < 3; ++c) {
    for (int y = 0; y < difference.size.height; ++y) {
      for (int x = 0; x < difference.size.width; ++x) {
        if (alpha.at(x, y) <= 0) continue;
        const double value = difference.layers[c].plane.at(x, y);
        sum += value;
        squares += value * value;
        greatest = std::max(greatest, std::abs(value));
        ++count;
      }
    }
  }
  count = std::max(count, 1.0);
  return {{"mean radiance", mean_radiance},
          {"mean difference", sum / count},
          {"rms difference", std::sqrt(squares / count)},
          {"greatest difference", greatest}};
}

}  // namespace kiln
