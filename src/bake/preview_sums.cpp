// SPDX-License-Identifier: Apache-2.0
#include "preview_sums.h"

#include <algorithm>
#include <cmath>

#include "preview_blocks.h"

namespace kiln {
namespace {

// Calls visit(x) for the pixels of a row that are shown.
template <class Visit>
void for_shown(const Layers& image, int y, const Visit& visit) {
  const auto alpha = image.layers[3].plane.texels_of_row(y);
  for (size_t x = 0; x < alpha.size(); ++x) {
    if (alpha[x] > 0) visit(static_cast<int>(x));
  }
}

// Of three planes from `first` on.
double sum_of_three(const Layers& image, size_t first, int y) {
  double sum = 0;
  for (size_t c = first; c < first + 3; ++c) {
    const float* row = image.layers[c].plane.row(y);
    for_shown(image, y, [&](int x) { sum += row[x]; });
  }
  return sum;
}

}  // namespace

PictureSums::PictureSums(Size picture, double target_error)
    : target_error_(target_error), rows_(static_cast<size_t>(picture.height)) {}

void PictureSums::add_reference(int first, const Layers& rows) {
  for (int y = 0; y < rows.size.height; ++y) {
    Row& row = rows_[static_cast<size_t>(first + y)];
    row.radiance = sum_of_three(rows, 0, y);
    row.error = sum_of_three(rows, 4, y);
    const float* counts = rows.layers[points_plane].plane.row(y);
    for_shown(rows, y, [&](int x) {
      ++row.shown;
      row.samples += counts[x];
      row.most = std::max(row.most, double{counts[x]});
    });
  }
  if (target_error_ > 0) {
    rows_[static_cast<size_t>(first)].above = pixels_above(rows, target_error_);
  }
}

void PictureSums::add_difference(int first, const Layers& rows) {
  for (int y = 0; y < rows.size.height; ++y) {
    Row& row = rows_[static_cast<size_t>(first + y)];
    for (size_t c = 0; c < 3; ++c) {
      const float* values = rows.layers[c].plane.row(y);
      for_shown(rows, y, [&](int x) {
        const double value = values[x];
        row.difference += value;
        row.squares += value * value;
        row.greatest = std::max(row.greatest, std::abs(value));
      });
    }
  }
}

void PictureSums::add_glass(int first, const Layers& rows, const Plane& carried,
                            const Plane& trapped) {
  for (int y = 0; y < rows.size.height; ++y) {
    Row& row = rows_[static_cast<size_t>(first + y)];
    const float *left = carried.row(y), *ended = trapped.row(y);
    for_shown(rows, y, [&](int x) {
      row.carried += left[x];
      row.trapped += ended[x];
    });
  }
}

PictureFacts PictureSums::facts() const {
  Row all;
  for (const Row& row : rows_) {
    all.shown += row.shown;
    all.radiance += row.radiance;
    all.error += row.error;
    all.samples += row.samples;
    all.most = std::max(all.most, row.most);
    all.above += row.above;
    all.carried += row.carried;
    all.trapped += row.trapped;
    all.difference += row.difference;
    all.squares += row.squares;
    all.greatest = std::max(all.greatest, row.greatest);
  }
  const double pixels = std::max(all.shown, 1.0), colors = 3 * pixels;
  return {.mean_samples = all.samples / pixels,
          .most_samples = all.most,
          .mean_error = all.error / colors,
          .above_target = all.above / pixels,
          .mean_radiance = all.radiance / colors,
          .lost = 1 - all.carried / pixels,
          .trapped = all.trapped / pixels,
          .mean_difference = all.difference / colors,
          .rms_difference = std::sqrt(all.squares / colors),
          .greatest_difference = all.greatest};
}

}  // namespace kiln
