// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "kiln/integrate/sobol.h"
#include "light_product.h"
#include "preview_stages.h"
#include "shading_point.h"

namespace kiln {

StagedPoint make_staged_point(const TexelValues<WideFloat>& texel,
                              const Placement<WideFloat>& placement, const AlbedoTable& table,
                              const SurfaceStages& stages);

/// As estimate.h's: the sum over the points [first, last) of the set of f L cos / (p_e + p_b).
WideVec sum_points(const StagedPoint& point, const SurfaceStages& stages,
                   const Environment& environment, const AlbedoTable& table,
                   const SobolPoints& points, int first, int last,
                   const std::array<WideUint, 4>& seeds);

/// As estimate.h's: f E cos of a light far away.
WideVec reflect_distant(const StagedPoint& point, const SurfaceStages& stages,
                        const AlbedoTable& table, const WideVec& toward, const WideVec& irradiance);

/// Prefiltered radiance times split-sum terms, irradiance times albedo.
WideVec approximate(const StagedPoint& point, const SurfaceStages& stages, const Light& light);

}  // namespace kiln
