// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "kiln/image/layers.h"
#include "kiln/light/sphere_layout.h"

namespace kiln {

/// The shape of a filter: an isotropic distribution of microfacet normals.
struct FilterLobe {
  std::string distribution = "ggx";
  double alpha = 1;     ///< (0, 1]
  double shape = 0;     ///< of distributions that have one; 0: its default
  bool masked = false;  ///< GGX with K = straight_lobe(), else K as of Prefilter

  bool operator==(const FilterLobe&) const = default;
};

/// Directions to look in with a lobe.
struct LobeProbe {
  FilterLobe lobe;
  std::vector<Vec3<double>> directions;  ///< unit
};

/// What a source is between the texel centres of one row.
enum class Across { Nothing, Straight };

/// An environment, expanded in spherical harmonics so that it can be filtered with any lobe.
///
/// With normal = view = direction d, the filtered radiance is
///
///     sum L(w) K(d.w) dw / sum K(d.w) dw,    K(c) = D(h) c if c > 0, else 0,  n.h = sqrt((1 +
///     c)/2)
///
/// over the texels of the source as point masses of exact solid angle. By the Funk-Hecke theorem
/// that is a product band by band; the few texels that hold so much power that the cut of the
/// expansion would show around them are left out of it and added exactly.
///
/// A fourth plane W may hold point masses of radiance 1 (point_masses_of): then values are divided
/// by what the sum makes of these, instead of the texels' own solid angles.
///
/// At alpha = 1 the lobe of GGX is the clamped cosine: filtering with it gives irradiance over pi.
/// @accuracy  1e-5 rms of the mean radiance, 1e-3 at the peak of a single-texel sun
/// @source    Walter et al. 2007 (GGX); Karis 2013 (n = v = r)
class Prefilter {
 public:
  /// Lobes narrower than this need more harmonics than the recurrences hold.
  static constexpr double least_alpha = 4e-3;

  /// @param latlong  planes R G B (or one plane, grey), values at texel centres, finite; outlives
  ///                 this. One too coarse for the sharpest lobe is first made finer, bilinearly
  /// @param lobes    those that will be asked for
  /// @param across   Nothing: texels are point masses; Straight: along a row each is spread over
  /// its
  ///                 neighbours as by linear interpolation, exactly
  /// @error Fault::Input when the image is empty or has neither one nor three colours;
  ///        Fault::Usage when a lobe is narrower than least_alpha, or its distribution unknown
  Prefilter(const Layers& latlong, const std::vector<FilterLobe>& lobes,
            Across across = Across::Nothing);
  ~Prefilter();
  Prefilter(Prefilter&&) noexcept;

  /// Of the source as it is filtered.
  Size source_size() const;

  /// The filtered environment at the samples of a grid: one image or six faces.
  std::vector<Layers> filter(const FilterLobe& lobe, const SphereGrid& grid) const;

  /// The same for each of several grids, which share the work of the convolution.
  std::vector<std::vector<Layers>> filter_each(const FilterLobe& lobe,
                                               const std::vector<SphereGrid>& grids) const;

  /// Integral of K of one of the lobes over the sphere [sr].
  double integral_of(const FilterLobe& lobe) const;

  /// What filter() approximates, texel by texel of the source: R, G, B for each direction of each
  /// probe.
  /// @accuracy  1e-6 relative
  std::vector<std::vector<Vec3<double>>> brute_force(const std::vector<LobeProbe>& probes) const;

 private:
  struct Expanded;
  std::unique_ptr<Expanded> expanded_;
};

/// The environment averaged over the area of each texel of a grid (at nodes, over what is nearest):
/// one image or six faces. A constant stays that constant, and the mean over the sphere its mean to
/// 1e-4.
/// @param latlong  planes R G B (or one plane, grey), values at texel centres, finite
std::vector<Layers> average_over_texels(const Layers& latlong, const SphereGrid& grid);

}  // namespace kiln
