// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "kiln/bake/products.h"
#include "picture.h"

namespace kiln {

/// What a picture is lit with and by which models.
struct ShadingInputs {
  const Light* light;
  const AlbedoTable* albedo;
  std::string diffuse;  ///< a name on the list of diffuse models
  Energy energy;
};

/// Independent scramblings of the point set, from which standard errors are found.
inline constexpr int repetitions = 8;

/// The least number of directions per texel, not below `wanted`, that fills all repetitions and
/// positions with whole points (a point gives two directions).
int whole_samples(int wanted, int positions);

/// Reference: planes R G B A stderr.R stderr.G stderr.B.
Layers estimate_picture(const Picture& picture, const ShadingInputs& inputs, int samples, int seed);

/// What an engine shows: prefiltered radiance times split-sum terms, irradiance times albedo.
/// Planes R G B A.
Layers approximate_picture(const Picture& picture, const ShadingInputs& inputs);

}  // namespace kiln
