// SPDX-License-Identifier: Apache-2.0
#include "preview_blocks.h"

namespace kiln {
namespace {

int blocks_along(int extent) { return (extent + block_edge - 1) / block_edge; }

}  // namespace

int block_count(Size picture) { return blocks_along(picture.width) * blocks_along(picture.height); }

PixelBlock::PixelBlock(Size picture, int index)
    : first_x_(index % blocks_along(picture.width) * block_edge),
      first_y_(index / blocks_along(picture.width) * block_edge),
      last_x_(std::min(first_x_ + block_edge, picture.width)),
      last_y_(std::min(first_y_ + block_edge, picture.height)) {}

PixelBlock::Errors PixelBlock::errors(const Layers& image) const {
  Errors found;
  for (int y = first_y_; y < last_y_; ++y) {
    for (int x = first_x_; x < last_x_; ++x) {
      if (image.layers[3].plane.at(x, y) <= 0) continue;
      for (size_t c = 4; c < 7; ++c) found.sum += image.layers[c].plane.at(x, y);
      ++found.shown;
    }
  }
  return found;
}

double pixels_above(const Layers& image, double error) {
  double above = 0;
  for (int i = 0; i < block_count(image.size); ++i) {
    const PixelBlock::Errors found = PixelBlock(image.size, i).errors(image);
    if (found.mean() > error) above += found.shown;
  }
  return above;
}

void PixelBlock::fill(Plane& plane, float value) const {
  for (int y = first_y_; y < last_y_; ++y) {
    std::fill(plane.row(y) + first_x_, plane.row(y) + last_x_, value);
  }
}

Layers make_sampled_image(const Picture& picture) {
  Layers image = make_layers(
      picture.size(), {"R", "G", "B", "A", "stderr.R", "stderr.G", "stderr.B", "samples.count"});
  fill_coverage(picture, image);
  return image;
}

}  // namespace kiln
