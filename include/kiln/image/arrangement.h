// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <string_view>

#include "kiln/image/sphere_image.h"

namespace kiln {

/// What a file says of itself as an environment (the OpenEXR attribute `envmap`).
enum class Envmap { None, LatLong, Cube };

/// How an image file holds the sphere, as users say it.
enum class Arrangement {
  Auto,        ///< what the file says of itself, else by aspect ratio
  LatLong,     ///< 2:1
  CubeStrip,   ///< six faces px nx py ny pz nz, side by side (6:1) or one above the other (1:6)
  CubeCross,   ///< an unfolded cube, lying (4:3) or standing (3:4)
  CubeFaces,   ///< six files
  Octahedral,  ///< 1:1
};
inline constexpr std::array<std::string_view, 6> arrangement_names = {
    "auto", "latlong", "cube-strip", "cube-cross", "cube-faces", "octahedral"};

/// What is known of an image before its texels are looked at.
struct ImageMarks {
  Size size;
  Envmap envmap = Envmap::None;
  bool node_aligned = false;
};

/// An arrangement, decided, and why.
struct ArrangementChoice {
  Arrangement arrangement = Arrangement::LatLong;
  std::string reason;  ///< "2:1", "the attribute envmap", "as stated"
};

/// Decides how one image is to be read.
/// @param stated  Auto: a square image is not guessed to be anything
/// @error Fault::Input when the size does not fit, with what was found and what was expected
ArrangementChoice choose_arrangement(Arrangement stated, const ImageMarks& marks);

/// The sphere out of one image.
///
/// Faces have the orientation of CubeFace, except in files marked Envmap::Cube: these are strips
/// in the orientation of OpenEXR, px (1, -t, s), nx (-1, -t, -s), py (s, 1, -t), ny (s, -1, t),
/// pz (-s, -t, 1), nz (s, -t, -1). Crosses are
///
///        py                 py
///     nx pz px nz        nx pz px        the last one turned by half a turn, so that it continues
///        ny                 ny           what is above it
///                           nz
///
/// @param arrangement  decided, of one file
/// @source ImfEnvmap.h of OpenEXR
SphereImage arranged(Layers image, Arrangement arrangement, const ImageMarks& marks);

}  // namespace kiln
