// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "kiln/bake/surface_choice.h"
#include "kiln/brdf/models.h"
#include "kiln/math/frame.h"
#include "kiln/table/albedo_table.h"

namespace kiln {

// Any listed distribution, masking, Fresnel, diffuse, energy and coupling, in stages over blocks of
// directions that stay in the first-level cache: the lobe, then its Fresnel, then the diffuse lobe,
// then energy and coupling. Each stage is a function chosen once per picture, so code grows as the
// sum of the lists, not as their product. The common models have a fused loop instead: estimate.h.

/// One colour channel as far as averages over directions are concerned: its Fresnel reflectance as
/// F0 + (F90 - F0)(1 - c)^5 - dip c (1 - c)^6, with the average that it has.
struct ChannelTerms {
  WideFloat f0, f90, dip, average;
};

/// The lobe's integrals for one direction.
struct DirectionTerms {
  SplitSumTerms<WideFloat> split;
  WideFloat edge;
};

/// Everything about a texel that does not depend on the light, for any models.
struct StagedPoint {
  Frame<WideFloat> frame;  ///< shading frame, +z the bent normal
  Vec3<WideFloat> wo;
  WideFloat roughness, occlusion;
  WideFloat alpha_x, alpha_y;  ///< along the frame's axes
  Vec3<WideFloat> diffuse_color;
  std::array<FresnelChannel<WideFloat>, 3> fresnel;
  std::array<ChannelTerms, 3> channels;
  AlbedoRow<WideFloat> row;
  DirectionTerms terms_o, average;
  WideFloat bounded_average;                 ///< of min(E, 1)
  Vec3<WideFloat> single_o, single_average;  ///< reflectance of the lobe with its Fresnel
  Vec3<WideFloat> total_o, total_average;    ///< and with its energy
  WideFloat specular_share;                  ///< probability to sample the specular lobe
  float shape = 0;                           ///< of the distribution
};

/// Directions at one texel and what the stages make of them.
struct DirectionBlock {
  static constexpr int capacity = 32;
  int count = 0;
  template <class T>
  using Of = std::array<T, capacity>;
  Of<Vec3<WideFloat>> wi;        ///< shading frame, raised above the horizon
  Of<WideFloat> reached;         ///< cosine to the normal, 0 below the horizon
  Of<Vec3<WideFloat>> light;     ///< radiance
  Of<Vec3<WideFloat>> known;     ///< what the control variate reflects of it [1/sr]
  Of<WideFloat> light_density;   ///< of the environment's sampler [1/sr]
  Of<WideFloat> own_density;     ///< of the texel's own [1/sr]
  Of<WideFloat> cosine;          ///< wo.wm
  Of<WideFloat> lobe;            ///< D V, the lobe with F = 1 [1/sr]
  Of<DirectionTerms> terms;      ///< of wi
  Of<Vec3<WideFloat>> single;    ///< reflectance of the lobe with its Fresnel toward wi
  Of<Vec3<WideFloat>> specular;  ///< F, then the lobe with its energy [1/sr]
  Of<Vec3<WideFloat>> diffuse;   ///< [1/sr]
  Of<WideFloat> reflectance;     ///< of the specular lobe toward wi, greatest channel
};

using WideVec = Vec3<WideFloat>;

/// The functions of the chosen models.
struct SurfaceStages {
  /// A microfacet normal for wo; u uniform in (0,1)^2.
  WideVec (*sample_normal)(const StagedPoint& point, const Vec2<WideFloat>& u) = nullptr;
  /// own_density, cosine and lobe of a block.
  void (*add_lobe)(const StagedPoint& point, DirectionBlock& block) = nullptr;
  /// fresnel, channels, single_o and single_average of a point, from F0 and the numbers of the
  /// choice.
  void (*set_fresnel)(const FresnelChannel<float>& numbers, const WideVec& f0,
                      StagedPoint& point) = nullptr;
  /// specular of a block: F; and single.
  void (*add_fresnel)(const StagedPoint& point, DirectionBlock& block) = nullptr;
  /// diffuse of a block.
  void (*add_diffuse)(const StagedPoint& point, DirectionBlock& block) = nullptr;
  /// What the diffuse lobe alone reflects toward wo.
  WideVec (*diffuse_albedo)(const StagedPoint& point) = nullptr;
  /// total_o and total_average of a point.
  void (*set_energy)(StagedPoint& point) = nullptr;
  /// specular of a block from F and lobe, and reflectance.
  void (*add_energy)(const StagedPoint& point, DirectionBlock& block) = nullptr;
  /// Weighs diffuse of a block by what the specular lobe leaves.
  void (*couple)(const StagedPoint& point, DirectionBlock& block) = nullptr;
  FresnelChannel<float> numbers = {};
  float shape = 0;
  bool anisotropic = true;     ///< the distribution has two widths
  bool alpha_is_width = true;  ///< of its slopes
};

/// @error Fault::Usage for names that are not listed or do not fit each other
SurfaceStages make_stages(const SurfaceChoice& surface);

/// sample_normal and add_lobe alone.
void choose_lobe(const SurfaceChoice& surface, SurfaceStages& stages);

/// set_energy, add_energy and couple alone.
void choose_energy(const SurfaceChoice& surface, SurfaceStages& stages);

}  // namespace kiln
