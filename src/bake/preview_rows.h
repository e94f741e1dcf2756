// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "kiln/bake/products.h"
#include "kiln/light/control_lobes.h"
#include "picture.h"
#include "preview_lights.h"

namespace kiln {

/// What a picture is lit with and by which models.
struct ShadingInputs {
  const Light* light;  ///< null: no environment
  const AlbedoTable* albedo;
  SurfaceChoice surface;
  std::vector<DirectionalLight> lights = {};
  const ControlLobes* controls = nullptr;  ///< null: every direction counts as it is
};

/// How many directions, or paths, each pixel gets.
struct SamplePlan {
  int samples = 0;          ///< whole_samples
  int most = 0;             ///< never more than these
  double target_error = 0;  ///< each block doubles its samples until its own is this; 0: none does
  int seed = 0;
};

/// The least number of directions per texel, not below `wanted`, that fills all repetitions and
/// positions with whole points (a point gives two directions).
int whole_samples(int wanted, int positions);

/// Whether these models have the fused loop of estimate.h: GGX with correlated Smith masking and
/// Schlick's Fresnel over any diffuse model, with Kulla and Conty's energy or none.
bool has_fused_loop(const SurfaceChoice& surface);

/// Reference: planes R G B A stderr.R stderr.G stderr.B samples.count. Directional lights are
/// summed exactly and have no standard error.
Layers estimate_picture(const Picture& picture, const ShadingInputs& inputs,
                        const SamplePlan& plan);

/// What an engine shows: prefiltered radiance times split-sum terms, irradiance times albedo, and
/// the same sum over directional lights. Planes R G B A.
Layers approximate_picture(const Picture& picture, const ShadingInputs& inputs);

}  // namespace kiln
