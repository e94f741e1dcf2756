// SPDX-License-Identifier: Apache-2.0
#include "preview_difference.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>

#include "kiln/math/vec.h"
#include "kiln/parallel/rows.h"
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

Color shown(float luminance, double scale) {
  return color_of(static_cast<float>(luminance / scale));
}

int legend_rows(Size picture) { return std::clamp(picture.width / 8, 8, 64); }

void put(Layers& image, int x, int y, const Color& color) {
  image.layers[0].plane.at(x, y) = color.x;
  image.layers[1].plane.at(x, y) = color.y;
  image.layers[2].plane.at(x, y) = color.z;
}

/// How many floats share half of their bits.
struct Counts {
  std::vector<size_t> counts = std::vector<size_t>(1 << 16);

  /// The half of the float of this rank, which becomes its rank among those that share it.
  std::uint32_t half_of(size_t& rank) const {
    std::uint32_t half = 0;
    while (rank >= counts[half]) rank -= counts[half++];
    return half;
  }
};

// Positive floats sort as their bits do: the float of a rank is found by its upper half, then by
// its lower one, and none need be kept.
// @param for_each  calls its argument with every luminance
template <class ForEach>
double scale_of(const ForEach& for_each) {
  const auto for_sizes = [&](const auto& visit) {
    for_each([&](float luminance) {
      const float size = std::abs(luminance);
      if (std::isfinite(size)) visit(std::bit_cast<std::uint32_t>(size));
    });
  };
  Counts upper, lower;
  size_t all = 0;
  for_sizes([&](std::uint32_t bits) { ++upper.counts[bits >> 16], ++all; });
  if (all == 0) return round_up(0);
  auto rank = static_cast<size_t>(share_within * static_cast<double>(all - 1));
  const std::uint32_t half = upper.half_of(rank);
  for_sizes([&](std::uint32_t bits) {
    if (bits >> 16 == half) ++lower.counts[bits & 0xffff];
  });
  return round_up(double{std::bit_cast<float>(half << 16 | lower.half_of(rank))});
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
  return scale_of([&](const auto& visit) {
    for (const Layers* image : differences) {
      const Plane& alpha = *image->find("A");
      for (int y = 0; y < image->size.height; ++y) {
        for (int x = 0; x < image->size.width; ++x) {
          if (alpha.at(x, y) > 0) visit(luminance_at(*image, x, y));
        }
      }
    }
  });
}

Layers paint_difference(const Layers& difference, double scale) {
  Layers painted = make_layers(difference.size, {"R", "G", "B", "A"});
  painted.layers[3].plane = *difference.find("A");
  for (int y = 0; y < painted.size.height; ++y) {
    for (int x = 0; x < painted.size.width; ++x) {
      put(painted, x, y, shown(luminance_at(difference, x, y), scale));
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
  const int strip = legend_rows(size);
  Layers view = make_layers({size.width, size.height + strip}, {"R", "G", "B", "A"});
  place(paint_difference(difference, scale), {0, 0}, view);
  place(difference_legend({size.width, strip}, scale), {0, size.height}, view);
  return view;
}

Plane difference_luminance(const Layers& difference) {
  Plane luminance(difference.size);
  for (int y = 0; y < difference.size.height; ++y) {
    for (int x = 0; x < difference.size.width; ++x) {
      luminance.at(x, y) = luminance_at(difference, x, y);
    }
  }
  return luminance;
}

ImageBands difference_bands(Plane luminance) {
  const double scale = scale_of([&](const auto& visit) {
    for (int y = 0; y < luminance.height(); ++y) {
      for (const float value : luminance.texels_of_row(y)) visit(value);
    }
  });
  const Size size = luminance.size();
  const auto held = std::make_shared<const Plane>(std::move(luminance));
  const auto legend =
      std::make_shared<const Layers>(difference_legend({size.width, legend_rows(size)}, scale));
  ImageBands bands;
  bands.size = {size.width, size.height + legend->size.height};
  bands.names = {"R", "G", "B", "A"};
  bands.band_rows = 64;
  bands.make = [held, legend, scale, size](int first, int rows) {
    Layers band = make_layers({size.width, rows}, {"R", "G", "B", "A"});
    band.layers[3].plane = Plane(band.size, 1);
    for_rows(std::clamp(size.height - first, 0, rows), [&](int y) {
      const float* values = held->row(first + y);
      for (int x = 0; x < size.width; ++x) put(band, x, y, shown(values[x], scale));
    });
    place(*legend, {0, size.height - first}, band);
    return band;
  };
  return bands;
}

}  // namespace kiln
