// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "kiln/image/sphere_image.h"

namespace kiln {

// Everything in this room reads lat-long images. An environment of another projection becomes two
// of them, since no one image is both: what is seen, interpolated between samples, and what the
// samples weigh, which has to be summed.

/// The radiance seen in each direction, as a lat-long image about as fine as the source at the
/// equator: 4N x 2N for a cube with faces of N, 2N x N for an octahedral image of N. Bilinear, on a
/// cube and on an octahedral image across the edges too, so that there are no seams.
/// @param source  not a lat-long image with samples on its borders
/// @error Fault::Input when the source has neither one nor three colours
Layers picture_of(const SphereImage& source);

/// What the samples of the source weigh, as a lat-long image twice as fine as the picture, planes
/// R G B and W. It is no picture, but a way to write down point masses, and may be negative.
///
/// Each sample is a mass, radiance times the solid angle that it stands for, at its own direction.
/// It is spread over 12 x 12 texels by the weights with which these, as values of a function, would
/// be interpolated there (Lagrange; across the poles with half a turn), and divided by their solid
/// angles. So for every function f that this interpolation reproduces
///
///     sum over texels of masses f dw = sum over samples of L f dw,
///
/// and convolving the image is as good as convolving the samples. W are the masses of radiance 1:
/// what a constant environment comes to in such a sum.
/// @param source    as of picture_of
/// @accuracy  harmonics up to a quarter of the number of rows (the edge of a cube face; at least
///            32): 1e-5 of the total power; total power: 1e-12
Layers point_masses_of(const SphereImage& source);

/// The faces of a cube averaged over the texels of smaller ones, weighted by exact solid angle. Of
/// the same size, the faces as they are; larger ones are read bilinearly.
/// @error Fault::Input as of picture_of
std::vector<Layers> average_faces(const SphereImage& cube, int size);

}  // namespace kiln
