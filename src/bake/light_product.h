// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "kiln/bake/products.h"
#include "kiln/image/sphere_image.h"
#include "kiln/light/control_lobes.h"
#include "kiln/light/environment.h"
#include "kiln/light/irradiance.h"
#include "kiln/light/radiance.h"
#include "kiln/light/specular_chain.h"
#include "kiln/parallel/once.h"

namespace kiln {

class Light {
 public:
  Layers latlong;  ///< radiance seen: planes R G B at texel centres, repaired
  /// Of a source that is no lat-long image: what its samples weigh (point_masses_of).
  std::optional<Layers> spread;
  std::optional<SphereImage> cube;  ///< the source where it is one, repaired and turned upright
  double rotate_deg = 0;
  Fixed fixed;                             ///< what was found in the file
  std::vector<std::string> notes;          ///< how it was read
  std::optional<Environment> environment;  ///< when `sampled` was asked for
  std::optional<SpecularChain> chain;      ///< when `prefiltered` was
  std::optional<IrradianceMap> irradiance;

  /// What has to be summed for means, harmonics and convolutions: texels as point masses. Where
  /// the source is a lat-long image, these are its own.
  const Layers& masses() const { return spread ? *spread : latlong; }

  /// Of the environment; made when first asked for, in about the time of a million directions.
  const ControlLobes& controls() const;

 private:
  mutable Once controls_once_;
  mutable std::optional<ControlLobes> controls_;
};

}  // namespace kiln
