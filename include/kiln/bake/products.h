// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "kiln/bake/surface_choice.h"
#include "kiln/image/sphere_image.h"

namespace kiln {

class AlbedoTable;

/// An environment ready to light with; shared by every task that names it.
class Light;

struct LightSettings {
  Mirror mirror = Mirror::None;  ///< of the image's own directions
  Up up = Up::Y;                 ///< of these too
  double rotate_deg = 0;         ///< after both; positive turns +Z toward +X [degree]
  std::string fix = "neighbors";
  bool sampled = true;             ///< make the distribution that directions are drawn from
  bool prefiltered = false;        ///< also make the specular chain and the irradiance
  int size = 256;                  ///< edge of a cube face of the chain [texel]
  std::vector<std::string> notes;  ///< how the image was read, repeated in what is made of it
};

struct LightMade {
  std::shared_ptr<const Light> light;
  std::vector<std::string>
      notes;  ///< counts of NaN, Inf, negative radiance and what became of them
};

/// @param image  planes R G B, linear, in the working space; its own `up` is Y
/// @error Fault::Input when radiance is not finite and is not to be fixed
LightMade make_light(SphereImage image, const LightSettings& settings);

/// The albedo table of the lobe of these models, which energy terms, coupling and split-sum
/// previews read.
/// @error Fault::Usage where the models do not fit each other
std::shared_ptr<const AlbedoTable> make_albedo_table(const SurfaceChoice& surface = {});

}  // namespace kiln
