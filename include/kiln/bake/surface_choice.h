// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "kiln/core/param.h"

namespace kiln {

/// What the maps of a set feed: models by their listed names, and the numbers they take that no map
/// holds.
struct SurfaceChoice {
  std::string bsdf = "opaque";  ///< "opaque", or "glass": a rough dielectric, seen through
  std::string distribution = "ggx";
  std::string masking = "smith-correlated";
  std::string fresnel = "schlick";
  std::string diffuse = "eon";
  std::string energy = "kulla-conty";
  std::string coupling = "reciprocal";
  double distribution_shape = 0;  ///< 0: the model's default
  double f90 = 1;
  double f82 = 1;
  double edge_tint = 0;
  double dip = 0;
  double exponent = 6;
  double ior = 1.5;  ///< of glass; other models find theirs from the F0 of the maps
};

/// The keys of a pipeline's `material:` and the options of a preview; words are canonical
/// afterwards ("multiscatter" becomes "kulla-conty").
Params<SurfaceChoice> surface_params();

/// Whether the models fit each other.
/// @error Fault::Usage naming what does not fit and what would
void check_surface(const SurfaceChoice& surface);

/// "distribution=ggx masking=smith-correlated ...", as files carry it.
std::string surface_words(const SurfaceChoice& surface);

}  // namespace kiln
