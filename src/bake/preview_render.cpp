// SPDX-License-Identifier: Apache-2.0
#include "preview_render.h"

#include <utility>

#include "light_product.h"
#include "preview_blocks.h"
#include "preview_glass.h"

namespace kiln {
namespace {

using Settings = PreviewBake::Settings;

// Directions of a picture: 32 x 32 texels with 64 each. Making control lobes takes as long as a
// million; smaller pictures, thumbnails, are made sooner without.
constexpr double least_controlled = 1 << 16;

Layers render_reference(const Picture& picture, const ShadingInputs& inputs,
                        const Settings& settings, PictureSums& sums) {
  const SamplePlan plan{whole_samples(settings.samples, picture.positions()), most_samples,
                        settings.target_error, settings.seed};
  Layers image;
  if (is_glass(inputs)) {
    GlassPicture glass = estimate_glass(picture, inputs, plan);
    sums.add_glass(picture.first_row(), glass.image, glass.carried, glass.trapped);
    image = std::move(glass.image);
  } else {
    image = estimate_picture(picture, inputs, plan);
  }
  sums.add_reference(picture.first_row(), image);
  // The plane of counts is kept where they differ from place to place.
  if (settings.target_error <= 0) image.layers.erase(image.layers.begin() + points_plane);
  return image;
}

// The colours become those of `image` minus what they were.
void subtract_from(const Layers& image, Layers& colors) {
  for (size_t c = 0; c < 3; ++c) {
    const Plane& other = image.layers[c].plane;
    for (int y = 0; y < colors.size.height; ++y) {
      float* to = colors.layers[c].plane.row(y);
      for (int x = 0; x < colors.size.width; ++x) to[x] = other.at(x, y) - to[x];
    }
  }
}

}  // namespace

bool is_glass(const ShadingInputs& inputs) { return inputs.surface.bsdf == "glass"; }

ShadingInputs with_controls(ShadingInputs inputs, const Settings& settings, Size picture) {
  const bool sampled = inputs.light != nullptr && inputs.light->environment &&
                       settings.mode != PreviewBake::Mode::SplitSum && !is_glass(inputs);
  const int samples = settings.target_error > 0 ? most_samples : settings.samples;
  if (sampled && static_cast<double>(area(picture)) * samples >= least_controlled) {
    inputs.controls = &inputs.light->controls();
  }
  return inputs;
}

std::vector<std::string> rendered_planes(const Settings& settings) {
  if (settings.mode == PreviewBake::Mode::SplitSum) return {"R", "G", "B", "A"};
  std::vector<std::string> names = {"R", "G", "B", "A", "stderr.R", "stderr.G", "stderr.B"};
  if (settings.target_error > 0) names.emplace_back("samples.count");
  return names;
}

Layers render_band(const Picture& band, const ShadingInputs& inputs, const Settings& settings,
                   PictureSums& sums) {
  if (settings.mode == PreviewBake::Mode::SplitSum) return approximate_picture(band, inputs);
  Layers image = render_reference(band, inputs, settings, sums);
  if (settings.mode == PreviewBake::Mode::Difference) {
    subtract_from(approximate_picture(band, inputs), image);
    sums.add_difference(band.first_row(), image);
  }
  return image;
}

Rendered render_preview(const Picture& picture, const ShadingInputs& inputs,
                        const Settings& settings) {
  PictureSums sums(picture.size(), settings.target_error);
  Layers image =
      render_band(picture, with_controls(inputs, settings, picture.size()), settings, sums);
  return {std::move(image), sums.facts()};
}

}  // namespace kiln
