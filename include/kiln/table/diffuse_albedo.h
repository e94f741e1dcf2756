// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace kiln {

/// A diffuse surface of one colour channel, by the name of its model.
struct DiffuseSurface {
  std::string model = "eon";
  double roughness = 0.5;  ///< as the model reads it
  double color = 1;        ///< reflectance [0..1]; 1 is white
};

/// Directional albedo of a listed diffuse model, INT f (n.wi) dwi, by quadrature whether or not the
/// model has a closed form.
///
/// Models of rough diffuse surfaces have kinks where both directions are equally steep and where
/// they are at right angles in azimuth; the rules end there. The elevation of wi is mu sinh x, so
/// that the scale of a grazing wo is met from all sides.
///
/// @param mu     cosine of wo, [1e-4, 1], clamped
/// @param order  points between two edges, along each of the two directions
/// @accuracy     1e-12 at 32 (Burley's; others better), 1e-8 at 24
/// @error        Fault::Usage for a name that is not on the list of diffuse models
double integrate_diffuse(const DiffuseSurface& surface, double mu, int order = 32);

/// Cosine-weighted average over directions, 2 INT_0^1 E(mu) mu dmu.
double integrate_diffuse_average(const DiffuseSurface& surface, int order = 32);

}  // namespace kiln
