// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "light_control.h"
#include "light_product.h"
#include "preview_pixels.h"
#include "preview_stages.h"
#include "shading_point.h"

namespace kiln {

StagedPoint make_staged_point(const TexelValues<WideFloat>& texel,
                              const Placement<WideFloat>& placement, const AlbedoTable& table,
                              const SurfaceStages& stages);

/// As estimate.h's sum_points for each repetition, added to its sum.
void add_points(const StagedPoint& point, const LightControl<WideFloat>& control,
                const SurfaceStages& stages, const Environment& environment,
                const AlbedoTable& table, const ScrambledPoints& points, RepetitionSums& sums);

/// What the diffuse lobe reflects toward the viewer of what the specular one leaves.
WideVec diffuse_reflectance(const StagedPoint& point, const SurfaceStages& stages);

/// As estimate.h's: f E cos of a light far away.
WideVec reflect_distant(const StagedPoint& point, const SurfaceStages& stages,
                        const AlbedoTable& table, const WideVec& toward, const WideVec& irradiance);

/// Prefiltered radiance times split-sum terms, irradiance times albedo.
WideVec approximate(const StagedPoint& point, const SurfaceStages& stages, const Light& light);

}  // namespace kiln
