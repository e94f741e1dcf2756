// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "kiln/bake/products.h"
#include "picture.h"

namespace kiln {

/// What a picture is lit with and by which models.
struct ShadingInputs {
  const Light* light;
  const AlbedoTable* albedo;
  SurfaceChoice surface;
};

/// The least number of directions per texel, not below `wanted`, that fills all repetitions and
/// positions with whole points (a point gives two directions).
int whole_samples(int wanted, int positions);

/// Whether these models have the fused loop of estimate.h: GGX with correlated Smith masking and
/// Schlick's Fresnel over any diffuse model, with Kulla and Conty's energy or none.
bool has_fused_loop(const SurfaceChoice& surface);

/// Reference: planes R G B A stderr.R stderr.G stderr.B.
Layers estimate_picture(const Picture& picture, const ShadingInputs& inputs, int samples, int seed);

/// What an engine shows: prefiltered radiance times split-sum terms, irradiance times albedo.
/// Planes R G B A.
Layers approximate_picture(const Picture& picture, const ShadingInputs& inputs);

}  // namespace kiln
