// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "kiln/bake/surface_choice.h"
#include "kiln/image/layers.h"

namespace kiln {

class AlbedoTable;

/// An environment ready to light with; shared by every task that names it.
class Light;

struct LightSettings {
  bool node_aligned = false;
  double rotate_deg = 0;  ///< positive turns +Z toward +X [degree]
  std::string fix = "neighbors";
  bool prefiltered = false;  ///< also make the specular chain and the irradiance
  int size = 256;            ///< edge of a cube face of the chain [texel]
};

struct LightMade {
  std::shared_ptr<const Light> light;
  std::vector<std::string>
      notes;  ///< counts of NaN, Inf, negative radiance and what became of them
};

/// @param latlong  planes R G B, linear, in the working space
LightMade make_light(Layers latlong, const LightSettings& settings);

/// The albedo table of the lobe of these models, which energy terms, coupling and split-sum
/// previews read.
/// @error Fault::Usage where the models do not fit each other
std::shared_ptr<const AlbedoTable> make_albedo_table(const SurfaceChoice& surface = {});

}  // namespace kiln
