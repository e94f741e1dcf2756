// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>

#include "color_planes.h"
#include "kiln/light/source.h"
#include "kiln/parallel/rows.h"
#include "source_rows.h"

namespace kiln {
namespace {

constexpr int taps = 12;
constexpr int channels = 4;  // R G B W
// So many carry harmonics of order 32, however coarse the source.
constexpr int fewest_rows = 128;

using Powers = std::array<double, channels>;

/// Weights of `taps` neighbouring values in an interpolation between them.
struct Stencil {
  int first;
  std::array<double, taps> weights;
};

// Lagrange's: weight k is the product over j != k of (t - j) / (k - j), here as what stands to the
// left of k times what stands to its right.
Stencil stencil_at(double position) {
  static const std::array<double, taps> scales = [] {
    std::array<double, taps> result;
    for (int k = 0; k < taps; ++k) {
      double product = 1;
      for (int j = 0; j < taps; ++j) product *= j == k ? 1 : k - j;
      result[static_cast<size_t>(k)] = 1 / product;
    }
    return result;
  }();
  const double below = std::floor(position);
  Stencil stencil{static_cast<int>(below) - (taps / 2 - 1), scales};
  const double t = position - stencil.first;
  double left = 1, right = 1;
  for (int k = 0; k < taps; ++k) {
    stencil.weights[static_cast<size_t>(k)] *= left;
    left *= t - k;
    stencil.weights[static_cast<size_t>(taps - 1 - k)] *= right;
    right *= t - (taps - 1 - k);
  }
  return stencil;
}

/// Rows of the image being made, as powers; columns go on to the right by as many as a stencil can
/// reach over the seam.
class Band {
 public:
  Band(Size image, int begin, int end)
      : image_(image),
        begin_(begin),
        end_(end),
        stride_(static_cast<size_t>(image.width + taps - 1)),
        powers_(static_cast<size_t>(end - begin) * channels * stride_) {}

  int begin() const { return begin_; }
  int end() const { return end_; }

  void spread(const Stencil& down, const Stencil& across, const Powers& power) {
    for (int k = 0; k < taps; ++k) {
      const int row = down.first + k;
      const bool beyond = row < 0 || row >= image_.height;
      const int inside = row < 0 ? -1 - row : beyond ? 2 * image_.height - 1 - row : row;
      if (inside < begin_ || inside >= end_) continue;
      const int turn = beyond ? image_.width / 2 : 0;
      const int column = ((across.first + turn) % image_.width + image_.width) % image_.width;
      add(inside, column, across.weights, down.weights[static_cast<size_t>(k)], power);
    }
  }

  void close_seam() {
    for (size_t at = 0; at < powers_.size(); at += stride_) {
      double* row = powers_.data() + at;
      for (int x = 0; x < taps - 1; ++x) row[x] += row[image_.width + x];
    }
  }

  // Rounding a texel leaves a little power over, which goes to the next; returns what is left.
  Powers write_to(Layers& image) const {
    Powers carried{};
    for (int y = begin_; y < end_; ++y) {
      const double solid_angle = latlong_texel_solid_angle(image_, y), inverse = 1 / solid_angle;
      const double* from = row(y);
      std::array<float*, channels> to;
      for (size_t c = 0; c < channels; ++c) to[c] = image.layers[c].plane.row(y);
      for (int x = 0; x < image_.width; ++x) {
        for (size_t c = 0; c < channels; ++c) {
          carried[c] += from[c * stride_ + static_cast<size_t>(x)];
          to[c][x] = static_cast<float>(carried[c] * inverse);
          carried[c] -= solid_angle * to[c][x];
        }
      }
    }
    return carried;
  }

 private:
  const double* row(int y) const {
    return powers_.data() + static_cast<size_t>(y - begin_) * channels * stride_;
  }

  void add(int y, int column, const std::array<double, taps>& weights, double weight,
           const Powers& power) {
    double* to = powers_.data() + static_cast<size_t>(y - begin_) * channels * stride_ + column;
    for (size_t c = 0; c < channels; ++c, to += stride_) {
      const double scale = weight * power[c];
      for (size_t i = 0; i < taps; ++i) to[i] += scale * weights[i];
    }
  }

  Size image_;
  int begin_, end_;
  size_t stride_;
  std::vector<double> powers_;
};

/// A row of samples of the source, and between which heights (cosines of polar angles) it lies.
struct SampleRow {
  int image, y;
  double lowest, highest;
};

std::vector<SampleRow> rows_of(const SphereImage& source) {
  const Size size = source.size();
  std::vector<SampleRow> rows(source.images.size() * static_cast<size_t>(size.height));
  for_rows(static_cast<int>(rows.size()), [&](int i) {
    SampleRow row{i / size.height, i % size.height, 1, -1};
    for (int x = 0; x < size.width; ++x) {
      const double height = sample_direction(source, row.image, x, row.y).y;
      row.lowest = std::min(row.lowest, height);
      row.highest = std::max(row.highest, height);
    }
    rows[static_cast<size_t>(i)] = row;
  });
  return rows;
}

class Spreading {
 public:
  Spreading(const SphereImage& source, Size image)
      : source_(source), image_(image), rows_(rows_of(source)) {
    for (const Layers& one : source.images) colors_.push_back(color_planes(one));
  }

  // In the order of the samples, so that sums do not depend on how bands are dealt out.
  void fill(Band& band) const {
    // Heights of what can reach the band, with something to spare.
    const double step = pi / image_.height;
    const double top = band.begin() - taps, bottom = band.end() + taps;
    const double highest = std::cos(std::max(0.0, top * step));
    const double lowest = std::cos(std::min(pi, bottom * step));
    for (const SampleRow& row : rows_) {
      if (row.lowest > highest || row.highest < lowest) continue;
      for (int x = 0; x < source_.size().width; ++x) {
        const Vec3<double> d = sample_direction(source_, row.image, x, row.y);
        if (d.y <= highest && d.y >= lowest) spread(d, row.image, x, row.y, band);
      }
    }
  }

 private:
  void spread(const Vec3<double>& d, int image, int x, int y, Band& band) const {
    const Vec2<double> uv = direction_to_latlong(d);
    const double solid_angle = sample_solid_angle(source_, x, y);
    const Vec3<double> power = colors_[static_cast<size_t>(image)].at(x, y) * solid_angle;
    band.spread(stencil_at(uv.y * image_.height - 0.5), stencil_at(uv.x * image_.width - 0.5),
                {power.x, power.y, power.z, solid_angle});
  }

  const SphereImage& source_;
  Size image_;
  std::vector<SampleRow> rows_;
  std::vector<ColorPlanes> colors_;
};

// Along the first row, whose texels are so small that what is lost to rounding there is nothing.
void add_left_over(const std::vector<Powers>& left_over, Layers& image) {
  const double solid_angle = latlong_texel_solid_angle(image.size, 0);
  for (size_t c = 0; c < channels; ++c) {
    double carried = 0;
    for (const Powers& one : left_over) carried += one[c];
    for (int x = 0; x < image.size.width; ++x) {
      float& texel = image.layers[c].plane.at(x, 0);
      const double old = texel;
      texel = static_cast<float>(old + carried / solid_angle);
      carried -= solid_angle * (texel - old);
    }
  }
}

}  // namespace

Layers point_masses_of(const SphereImage& source) {
  const int height = std::clamp(2 * source_rows(source), fewest_rows, most_rows);
  Layers image = make_layers({2 * height, height}, {"R", "G", "B", "W"});
  const Spreading spreading(source, image.size);
  constexpr int bands = 64;
  std::vector<Powers> left_over(bands);
  for_rows(bands, [&](int i) {
    Band band(image.size, height * i / bands, height * (i + 1) / bands);
    spreading.fill(band);
    band.close_seam();
    left_over[static_cast<size_t>(i)] = band.write_to(image);
  });
  add_left_over(left_over, image);
  return image;
}

}  // namespace kiln
