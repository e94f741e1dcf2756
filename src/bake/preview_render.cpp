// SPDX-License-Identifier: Apache-2.0
#include "preview_render.h"

#include <algorithm>
#include <utility>

#include "preview_blocks.h"
#include "preview_glass.h"

namespace kiln {
namespace {

using Settings = PreviewBake::Settings;

// The plane of counts is kept where they differ from place to place.
void count_samples(const Settings& settings, Rendered& rendered) {
  std::vector<Layer>& layers = rendered.image.layers;
  const Plane& counts = layers.at(points_plane).plane;
  rendered.mean_samples = mean_of(rendered.image, {layers.at(points_plane).name});
  for (int y = 0; y < counts.height(); ++y) {
    for (const float count : counts.texels_of_row(y)) {
      rendered.most_samples = std::max(rendered.most_samples, double{count});
    }
  }
  if (settings.target_error <= 0) layers.erase(layers.begin() + points_plane);
}

Rendered render_reference(const Picture& picture, const ShadingInputs& inputs,
                          const Settings& settings) {
  const SamplePlan plan{whole_samples(settings.samples, picture.positions()), most_samples,
                        settings.target_error, settings.seed};
  Rendered rendered;
  if (is_glass(inputs)) {
    GlassPicture glass = estimate_glass(picture, inputs, plan);
    rendered.image = std::move(glass.image);
    rendered.lost = glass.lost;
    rendered.trapped = glass.trapped;
  } else {
    rendered.image = estimate_picture(picture, inputs, plan);
  }
  rendered.mean_error = mean_of(rendered.image, {"stderr.R", "stderr.G", "stderr.B"});
  rendered.mean_radiance = mean_of(rendered.image, {"R", "G", "B"});
  if (settings.target_error > 0) {
    rendered.above_target = share_above(rendered.image, settings.target_error);
  }
  count_samples(settings, rendered);
  return rendered;
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

double mean_of(const Layers& image, const std::vector<std::string>& names) {
  const Plane& alpha = *image.find("A");
  double sum = 0, shown = 0;
  for (const std::string& name : names) {
    const Plane& plane = *image.find(name);
    for (int y = 0; y < plane.height(); ++y) {
      for (int x = 0; x < plane.width(); ++x) {
        if (alpha.at(x, y) <= 0) continue;
        sum += plane.at(x, y);
        ++shown;
      }
    }
  }
  return shown > 0 ? sum / shown : 0;
}

Rendered render_preview(const Picture& picture, const ShadingInputs& inputs,
                        const Settings& settings) {
  if (settings.mode == PreviewBake::Mode::SplitSum) return {approximate_picture(picture, inputs)};
  Rendered rendered = render_reference(picture, inputs, settings);
  if (settings.mode == PreviewBake::Mode::Difference) {
    subtract_from(approximate_picture(picture, inputs), rendered.image);
  }
  return rendered;
}

}  // namespace kiln
