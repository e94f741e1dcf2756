// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "kiln/bake/products.h"
#include "kiln/light/environment.h"
#include "kiln/light/irradiance.h"
#include "kiln/light/radiance.h"
#include "kiln/light/specular_chain.h"

namespace kiln {

class Light {
 public:
  Layers latlong;  ///< planes R G B at texel centres, repaired
  double rotate_deg = 0;
  Fixed fixed;  ///< what was found in the file
  Environment environment;
  std::optional<SpecularChain> chain;  ///< when prefiltered was asked for
  std::optional<IrradianceMap> irradiance;
};

}  // namespace kiln
