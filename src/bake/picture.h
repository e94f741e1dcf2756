// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "shading_point.h"

namespace kiln {

/// Subpixel positions of pictures that resample their maps: a rotated grid.
inline constexpr int subpixels = 4;

/// The plane or the ball that a picture shows, and the maps on it.
///
/// Flat: the picture is the plane itself, +X right and +Y up, lit and seen as from `to_viewer`; one
/// output texel per map texel needs no filter. Ball: orthographic along -Z, u = longitude with two
/// repeats, v = latitude; the edge is antialiased by its exact distance, the background
/// transparent.
class Picture {
 public:
  struct Options {
    bool ball = false;
    Size size;                        ///< of the picture [texel]
    Vec3<double> to_viewer{0, 0, 1};  ///< of the plane; unit
    double rotate_deg = 0;            ///< of the environment: positive turns +Z toward +X [degree]
    int first_row = 0;                ///< of the whole plane, where the maps are a band of its rows
  };
  Picture(Svbrdf maps, const Options& options);

  /// Maps of so many texels each way, or more, make the same picture however often they are halved
  /// before; halved once more they would lack a level that is read.
  static Size texels_read(bool ball, Size size);

  Size size() const { return options_.size; }
  bool is_ball() const { return options_.ball; }
  /// Of the whole picture, which this is a band of.
  int first_row() const { return options_.first_row; }

  /// How many positions inside a pixel are shaded: 1 where picture and map texels coincide.
  int positions() const { return exact_ ? 1 : subpixels; }

  /// A direction of the picture's space (+X right, +Y up, +Z to the viewer) in the environment's.
  Vec3<double> to_environment(const Vec3<double>& w) const;

  /// Share of the pixel that the surface covers [0..1].
  float coverage(int x, int y) const;

  bool is_anisotropic() const { return !levels_.front().anisotropy.empty(); }

  /// Map values and placement of lane_count<F> pixels from x on. Pixels off the ball read its rim.
  template <class F>
  void fill(int x, int y, int position, TexelBlock<F>& texels, Placement<F>& placement) const;

  /// Roughness and normal of the maps, and the frame, where the ball's outward normal is this (in
  /// the environment's space, unit); other planes are 0. For paths inside the ball.
  template <class F>
  void fill_on_ball(const Vec3<F>& normal, TexelBlock<F>& texels, Frame<F>& frame) const;

 private:
  struct Spot {
    double u, v;
    double level;  ///< of the mip chain, from the size of the pixel on the map
    Frame<double> frame;
  };
  Spot spot_of_ball(double px, double py) const;
  Spot spot_on_ball(const Vec3<double>& normal) const;
  void read(const Spot& spot, const PlaneRange& planes, float* values) const;
  template <class F>
  void fill_texels(int x, int y, TexelBlock<F>& texels) const;
  Vec3<double> from_environment(const Vec3<double>& w) const;
  double radius() const;

  Options options_;
  bool exact_;
  std::vector<Svbrdf> levels_;
  double cos_rotate_, sin_rotate_;
  Placement<float> plane_;  ///< of every texel of a plane
};

}  // namespace kiln
