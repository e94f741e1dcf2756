// SPDX-License-Identifier: Apache-2.0
#include "kiln/light/environment.h"

#include <algorithm>
#include <bit>

#include "color_planes.h"
#include "kiln/core/error.h"
#include "kiln/parallel/rows.h"

namespace kiln {
namespace {

Size cells_of(const Layers& image, bool node_aligned) {
  const int border = node_aligned ? 1 : 0;
  const Size cells{image.size.width - border, image.size.height - border};
  if (cells.width < 1 || cells.height < 1) {
    throw Error(Fault::Input, "the environment image is " + std::to_string(image.size.width) + "x" +
                                  std::to_string(image.size.height) + ", too small to be lat-long");
  }
  return cells;
}

/// Halvings that find one of n entries.
int steps_for(int n) { return std::bit_width(static_cast<unsigned>(n - 1)); }

/// Luminance, at least 0, of one image row; [columns].
std::vector<double> luminance_of_row(const ColorPlanes& colors, int columns, int y) {
  std::vector<double> row(static_cast<size_t>(columns));
  for (int x = 0; x < columns; ++x) {
    row[static_cast<size_t>(x)] = std::max(0.0, luminance(colors.at(x, y)));
  }
  return row;
}

// What a bilinear lookup averages over a cell: [1 6 1] / 8 of the neighbours where the cell is a
// texel, [1 1] / 2 where it lies between nodes.
std::vector<double> mean_over_cells(const std::vector<double>& row, bool node_aligned) {
  const size_t n = row.size();
  std::vector<double> mean(n);
  for (size_t x = 0; x < n; ++x) {
    const double right = row[(x + 1) % n];
    mean[x] =
        node_aligned ? 0.5 * (row[x] + right) : 0.125 * (row[(x + n - 1) % n] + 6 * row[x] + right);
  }
  return mean;
}

std::vector<double> mean_luminance(const ColorPlanes& colors, Size cells, bool node_aligned,
                                   int y) {
  const auto row = [&](int at) {
    const int inside = std::clamp(at, 0, colors.size.height - 1);
    return mean_over_cells(luminance_of_row(colors, cells.width, inside), node_aligned);
  };
  std::vector<double> mean = row(y);
  const std::vector<double> below = row(y + 1);
  const std::vector<double> above = node_aligned ? below : row(y - 1);
  for (size_t x = 0; x < mean.size(); ++x) {
    mean[x] =
        node_aligned ? 0.5 * (mean[x] + below[x]) : 0.125 * (above[x] + 6 * mean[x] + below[x]);
  }
  return mean;
}

// Running sums divided by the total, entries past the end 2; all equal where nothing is positive.
// Returns the total.
double write_cumulative(const std::vector<double>& shares, float* to, size_t length) {
  double total = 0;
  for (double share : shares) total += share;
  double sum = 0;
  const size_t n = shares.size();
  for (size_t i = 0; i < length; ++i) {
    if (i > n) {
      to[i] = 2;
    } else if (i == n) {
      to[i] = 1;
    } else {
      to[i] = static_cast<float>(total > 0 ? std::min(1.0, sum / total)
                                           : static_cast<double>(i) / static_cast<double>(n));
      sum += shares[i];
    }
  }
  return total;
}

}  // namespace

Environment::Environment(const Layers& latlong, const EnvironmentOptions& options)
    : cells_(cells_of(latlong, options.node_aligned)), rotation_(options.rotate_deg / 360) {
  rotation_ -= std::floor(rotation_);
  texels_ = LatLongTexels(latlong, cells_.width, Pole::Clamped);
  scale_ = {static_cast<float>(cells_.width), static_cast<float>(cells_.height)};
  offset_ = options.node_aligned ? Vec2<float>{1, 1} : Vec2<float>{0.5f, 0.5f};
  build_density(latlong, options.node_aligned);
}

void Environment::build_density(const Layers& latlong, bool node_aligned) {
  const ColorPlanes colors = color_planes(latlong);
  row_steps_ = steps_for(cells_.height);
  column_steps_ = steps_for(cells_.width);
  coarse_steps_ = (column_steps_ + 1) / 2;
  rows_.resize((size_t{1} << row_steps_) + 1);
  const size_t row_length = (size_t{1} << column_steps_) + 1;
  columns_.resize(row_length * static_cast<size_t>(cells_.height));
  const size_t coarse_length = size_t{1} << coarse_steps_;
  coarse_columns_.resize(coarse_length * static_cast<size_t>(cells_.height));
  cosines_.resize(static_cast<size_t>(cells_.height) + 1);

  std::vector<double> shares(static_cast<size_t>(cells_.height));
  for_rows(cells_.height, [&](int y) {
    const auto row = static_cast<size_t>(y);
    const std::vector<double> mean = mean_luminance(colors, cells_, node_aligned, y);
    shares[row] = latlong_texel_solid_angle(cells_, y) *
                  write_cumulative(mean, columns_.data() + row * row_length, row_length);
    for (size_t i = 0; i < coarse_length; ++i) {
      coarse_columns_[row * coarse_length + i] =
          columns_[row * row_length + (i << (column_steps_ - coarse_steps_))];
    }
    cosines_[row] = static_cast<float>(std::cos(pi * y / cells_.height));
  });
  cosines_.back() = -1;
  if (write_cumulative(shares, rows_.data(), rows_.size()) <= 0) {
    // A black environment is sampled uniformly.
    for_rows(cells_.height,
             [&](int y) { shares[static_cast<size_t>(y)] = latlong_texel_solid_angle(cells_, y); });
    write_cumulative(shares, rows_.data(), rows_.size());
  }
  for_rows(cells_.height, [&](int y) {
    const auto row = static_cast<size_t>(y);
    store_density(y, double{rows_[row + 1]} - double{rows_[row]},
                  columns_.data() + row * row_length);
  });
}

// The border repeats nothing here: a cell is found inside the image.
void Environment::store_density(int row, double row_share, const float* cumulative) {
  const double solid_angle = latlong_texel_solid_angle(cells_, row);
  for (int x = 0; x < cells_.width; ++x) {
    const double share = row_share * (double{cumulative[x + 1]} - double{cumulative[x]});
    const double density = uniform_share / (4 * pi) + (1 - uniform_share) * share / solid_angle;
    texels_.set_fourth(x + 1, row + 1, static_cast<float>(density));
  }
}

}  // namespace kiln
