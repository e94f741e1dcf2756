// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <vector>

#include "kiln/image/layers.h"
#include "kiln/math/vec.h"

namespace kiln {

/// The axes of an engine in those of kiln (+Y up, right-handed): coordinate i of the engine is
/// sign[i] times coordinate axis[i] of kiln.
struct Axes {
  std::array<int, 3> axis{0, 1, 2};
  std::array<int, 3> sign{1, 1, 1};

  Vec3<double> to_engine(const Vec3<double>& d) const;
  Vec3<double> to_kiln(const Vec3<double>& d) const;
  bool is_identity() const { return *this == Axes{}; }
  /// Left and right exchanged, and nothing else.
  bool is_mirror() const { return *this == Axes{{0, 1, 2}, {-1, 1, 1}}; }

  bool operator==(const Axes&) const = default;
};

/// "x,y,z", "-x,y,z", "z,-x,y": the engine's x, y and z.
/// @error Fault::Usage when these are not three axes, each once
Axes parse_axes(const std::string& text);

/// The faces of a cube as the engine looks them up, with its own axes in the place of kiln's:
/// texels move as they are.
std::vector<Layers> faces_in(const Axes& axes, const std::vector<Layers>& faces);

}  // namespace kiln
