// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "kiln/image/layers.h"
#include "kiln/light/angles.h"
#include "kiln/light/latlong_texels.h"
#include "kiln/light/turn.h"
#include "kiln/math/vec.h"

namespace kiln {

/// Mean of radiance over the sphere; planes R G B (or one plane, grey), values at texel centres.
Vec3<double> mean_radiance(const Layers& latlong);

/// Irradiance over pi of a surface with the unit normal n, by brute force over texel centres with
/// exact solid angles.
Vec3<double> irradiance_over_pi(const Layers& latlong, const Vec3<double>& n);

/// The same for many normals at once, far cheaper each: [normals].
///
/// E(n) = n . sum of L w dw over the texels above the horizon of n. On one row of the image these
/// are an arc, so the sum is a difference of running sums of L, L sin(phi) and L cos(phi).
/// @accuracy  1e-12 of the mean radiance, against brute force
std::vector<Vec3<double>> irradiance_over_pi(const Layers& latlong,
                                             std::span<const Vec3<double>> normals);

/// The same divided by what the sum makes of the constant 1: a constant environment gives that
/// constant, whatever its size. A plane W is what the constant is there (point_masses_of).
std::vector<Vec3<double>> normalised_irradiance(const Layers& latlong,
                                                std::span<const Vec3<double>> normals);

/// Irradiance over pi of every normal, as a small lat-long image: the sum above over the same sum
/// for the constant 1, so that a constant environment gives that constant.
class IrradianceMap {
 public:
  static constexpr Size map_size{128, 64};

  /// @param latlong     planes R G B (or one plane, grey), values at texel centres, finite
  /// @param rotate_deg  as of Environment [degree]
  explicit IrradianceMap(const Layers& latlong, double rotate_deg = 0);

  /// Bilinear lookup; n unit.
  template <class F>
  Vec3<F> lookup(const Vec3<F>& n) const {
    const Vec2<F> uv = latlong_of(turn_.to_image(n));
    return texels_.bilinear(Vec2<F>{fma(uv.x, F(float{map_size.width}), F(0.5)),
                                    fma(uv.y, F(float{map_size.height}), F(0.5))});
  }

  /// Planes R G B in the orientation of the source image, rotation not applied.
  const Layers& image() const { return image_; }

 private:
  Layers image_;
  LatLongTexels texels_;
  Turn turn_;
};

}  // namespace kiln
