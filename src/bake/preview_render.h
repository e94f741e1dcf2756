// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bakes.h"
#include "preview_rows.h"
#include "preview_sums.h"

namespace kiln {

/// What a picture came to.
struct Rendered {
  Layers image;  ///< planes named rendered_planes()
  PictureFacts facts;
};

inline constexpr int most_samples = 1 << 14;

bool is_glass(const ShadingInputs& inputs);

/// With control lobes, unless the picture takes so few directions that it is made sooner without.
/// @param picture  the whole of it, if it is made in bands
ShadingInputs with_controls(ShadingInputs inputs, const PreviewBake::Settings& settings,
                            Size picture);

/// R G B A; where light is sampled stderr.R stderr.G stderr.B, and with a target error
/// samples.count.
std::vector<std::string> rendered_planes(const PreviewBake::Settings& settings);

/// In the mode of the settings; `difference` is split-sum minus reference.
Rendered render_preview(const Picture& picture, const ShadingInputs& inputs,
                        const PreviewBake::Settings& settings);

/// The same for a band of a picture (Picture::first_row); what is to be told is added up.
/// @param sums  of the whole picture
Layers render_band(const Picture& band, const ShadingInputs& inputs,
                   const PreviewBake::Settings& settings, PictureSums& sums);

}  // namespace kiln
