// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bakes.h"
#include "preview_rows.h"

namespace kiln {

/// What a picture came to.
struct Rendered {
  Layers image;  ///< R G B A; where light was sampled stderr.R stderr.G stderr.B; samples.count
  double mean_samples = 0, most_samples = 0;  ///< of a pixel
  double mean_error = 0;                      ///< mean standard error
  double above_target = 0;       ///< share of the pixels in blocks that miss the error asked for
  double mean_radiance = 0;      ///< of the reference
  double lost = 0, trapped = 0;  ///< of glass
};

inline constexpr int most_samples = 1 << 14;

bool is_glass(const ShadingInputs& inputs);

/// In the mode of the settings; `difference` is split-sum minus reference.
Rendered render_preview(const Picture& picture, const ShadingInputs& inputs,
                        const PreviewBake::Settings& settings);

/// Mean of planes over the pixels that are shown.
double mean_of(const Layers& image, const std::vector<std::string>& names);

}  // namespace kiln
