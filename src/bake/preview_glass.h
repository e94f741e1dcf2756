// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "preview_rows.h"

namespace kiln {

// Glass: the picture's body is a solid, clear dielectric whose boundary is rough as its maps say
// (roughness and normals; colours are not read). Paths start at the viewer, are reflected or
// refracted wherever they meet the boundary, by the BSDF's own sampler, and end in the
// environment when they leave.
//
// The ball is solid. The plane is the front of a thin slab: its back is smooth and parallel, and a
// path meets it where it met the front.
//
// Light is neither gained nor lost on the way, but for noise and the tables of albedos:
//  * what the single-bounce microfacet model loses is made up for by 1 over its albedo toward the
//    path (not with energy: none, where it stays lost);
//  * a direction that a bent normal sends through the wrong side of the true surface is mirrored at
//    that surface;
//  * a path that is still inside after most_bounces leaves straight on. Normal maps trap such
//    paths, for nothing turns them to where they may leave; how many they are is reported.

inline constexpr int most_bounces = 32;

struct GlassPicture {
  Layers image;   ///< planes R G B A stderr.R stderr.G stderr.B samples.count
  Plane carried;  ///< share of the light on paths that left [0..1]; noise goes beyond
  Plane trapped;  ///< share of the light on paths that were ended inside [0..1]
};

GlassPicture estimate_glass(const Picture& picture, const ShadingInputs& inputs,
                            const SamplePlan& plan);

}  // namespace kiln
