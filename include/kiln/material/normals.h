// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <string_view>

#include "kiln/image/layers.h"

namespace kiln {

/// Where the green channel of a normal map points: up the image (OpenGL) or down (DirectX).
enum class NormalConvention { Auto, OpenGl, DirectX };
inline constexpr std::array<std::string_view, 3> normal_convention_names = {"auto", "gl", "dx"};
constexpr std::string_view convention_text(NormalConvention convention) {
  return convention == NormalConvention::DirectX ? "DirectX (y down)" : "OpenGL (y up)";
}

/// Which stored value of red and green means zero slope.
///
/// `Both` is n = 2 v - 1 with the two middle codes of 8 bits, 127/255 and 128/255, taken as zero:
/// whichever of them the writer meant, flat is exactly flat, and no other 8-bit code moves. In
/// deeper files those two exact values are two of 65,536.
enum class NormalZero { Both, Exact, Code127, Code128 };
inline constexpr std::array<std::string_view, 4> normal_zero_names = {"both", "exact", "127",
                                                                      "128"};

/// Whether a file stores [0,1] or the components themselves; `Auto` takes negative values as a sign
/// of the latter.
enum class NormalRange { Auto, Unsigned, Signed };
inline constexpr std::array<std::string_view, 3> normal_range_names = {"auto", "unsigned",
                                                                       "signed"};

/// Whether blue is z, or z has to be rebuilt from red and green; `Auto` looks at the texels.
enum class NormalLayout { Auto, TwoChannel, ThreeChannel };

struct NormalDecoding {
  NormalConvention convention = NormalConvention::OpenGl;  ///< Auto is read as OpenGl
  NormalZero zero = NormalZero::Both;
  NormalRange range = NormalRange::Auto;
  NormalLayout layout = NormalLayout::Auto;
  float strength = 1;  ///< factor of x and y, before normals are made unit
};

/// How far the length of a stored normal may be from 1: as far as 8 bits put it, where every
/// component is off by half a code, 1/255, and red and green by the choice of the middle code
/// again, sqrt(2^2 + 2^2 + 1^2) / 255.
inline constexpr float unit_tolerance = 3.0f / 255.0f;

struct DecodedNormals {
  std::array<Plane, 3> normal;  ///< unit, +Y up, z > 0
  long long not_unit = 0;       ///< off by more than unit_tolerance: made unit; no degenerate ones
  long long degenerate = 0;     ///< shorter than 0.05: replaced by (0, 0, 1)
  long long below_surface = 0;  ///< z <= 0: z raised to 0.05, then normalised
  long long unreadable = 0;     ///< NaN or Inf: replaced by (0, 0, 1)
  bool two_channel = false;     ///< z was rebuilt from x and y
  bool signed_range = false;    ///< the file stores [-1, 1]
};

/// The least z that a normal below the surface is raised to, and the least by which slopes are
/// formed when normals are averaged: 87 degrees off the surface normal.
inline constexpr float least_normal_z = 0.05f;

/// Stored normals to unit vectors.
///
/// The first two planes are x and y, the third z. Where it is missing or constant while x or y are
/// not, the map has two channels and z = sqrt(1 - x^2 - y^2).
///
/// @error Fault::Input when the image has one channel only
DecodedNormals decode_normals(const Layers& stored, const NormalDecoding& decoding);

/// Flips +Y up to +Y down and back.
void flip_y(std::array<Plane, 3>& normal);

/// What a height map or the normals themselves say about the convention they were stored in.
struct ConventionGuess {
  NormalConvention convention = NormalConvention::Auto;  ///< Auto: nothing significant
  double correlation_x =
      0;  ///< of nx with dh/dx; of the mixed derivatives where no height is given
  double correlation_y = 0;  ///< of ny with dh/dy, y down
  std::string reason;        ///< the numbers in words, without the verdict
};

/// Pearson correlation of two columns of numbers, gathered one pair at a time.
struct Correlation {
  double n = 0, a = 0, b = 0, aa = 0, bb = 0, ab = 0;

  void add(double x, double y);
  double value() const;
  /// Texels of a picture are not independent: what counts is that the relation is visible.
  bool significant() const;
};

/// What tells the convention of a normal map, gathered from bands of rows. The normals are decoded
/// as if they were OpenGL.
class ConventionEvidence {
 public:
  /// Correlates normals with the gradient of a height map of the same size.
  void add(const std::array<Plane, 3>& normal, const Plane& height);
  /// Correlates the normals' own slopes.
  void add(const std::array<Plane, 3>& normal);

  ConventionGuess by_height() const;
  ConventionGuess by_slopes() const;

 private:
  Correlation x_, y_, mixed_;
};

/// Compares normals, decoded as if they were OpenGL, with the gradient of the height map.
///
/// A height field h has the normal (-dh/dx, -dh/dy_up, 1): nx falls with dh/dx, and with y counted
/// down the rows ny rises with dh/dy in OpenGL maps and falls in DirectX maps. A map of depth
/// instead of height turns both signs, so the product of the correlations decides.
ConventionGuess guess_convention(const std::array<Plane, 3>& normal, const Plane& height);

/// Without a height map: the slopes p = dh/dx and q = dh/dy of a height field satisfy dp/dy =
/// dq/dx, so the correlation of the two sides is positive in the right convention, negative in the
/// other.
ConventionGuess guess_convention(const std::array<Plane, 3>& normal);

}  // namespace kiln
