// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string_view>

namespace kiln {

/// How normals that differ within a footprint widen the lobe of the one normal that is left. Each
/// method keeps moments of the normals that average linearly, so that every level of a chain
/// follows from the texels of the first. Widths of lobes are squared alphas, and these add up:
///
/// * None: alpha'^2 = mean alpha^2. Normals do not count.
/// * Toksvig: from the length N of the mean normal, by way of Phong's exponent s = 2/alpha^2 - 2:
///   s' = s N / (N + s (1 - N)).
/// * Vmf: the von Mises-Fisher distribution of that N has N = coth k - 1/k: k = 1 / (1 - N), but
///   for exp(-2 k). Its slopes have the variance 1/k: alpha'^2 = alpha^2 + 2/k.
/// * Lean: first and second moments of slopes give their covariance S about the mean; alpha'^2 =
///   alpha^2 + 2 S is a matrix, of whose trace the isotropic half is taken. S is turned into the
///   frame of the mean normal: slopes shrink by 1 / (1 + m^2) along a mean slope m and by its root
///   across. Exact where slopes and lobe are Gaussian (Beckmann) about a level mean.
///
/// @source Toksvig 2005, "Mipmapping Normal Maps"; Olano and Baker 2010,
///         "LEAN Mapping"
enum class NormalFilter { None, Toksvig, Vmf, Lean };
inline constexpr std::array<std::string_view, 4> normal_filter_names = {"none", "toksvig", "vmf",
                                                                        "lean"};

struct NormalFiltering {
  NormalFilter method = NormalFilter::Vmf;
  double strength = 1;    ///< of what the normals add to alpha^2
  double most_added = 1;  ///< to alpha^2
};

/// How many numbers of a texel are averaged for it; the first is alpha^2.
int moment_count(NormalFilter method);

/// A row of a surface; rows are padded to whole vectors, as a Plane's.
struct SurfaceRow {
  int width = 0;
  const float* roughness = nullptr;         ///< perceptual
  std::array<const float*, 3> normal = {};  ///< unit, z > 0; not read by None
};

/// Writes the moments of a row, padding included.
void fill_moments(NormalFilter method, const SurfaceRow& row, float* const* moments);

/// A row of lobes; what is null is not wanted. Only Lean tells x from y.
struct LobeRow {
  float* roughness = nullptr;  ///< of the isotropic lobe, perceptual
  float* alpha_x = nullptr;    ///< the greater width
  float* alpha_y = nullptr;    ///< the lesser
  float* angle = nullptr;      ///< of alpha_x, counter-clockwise from +x, in half turns [0..1)
};

/// The lobes that averaged moments stand for, padding included; alpha is at most 1.
void lobes_of_moments(const NormalFiltering& filtering, int width, const float* const* moments,
                      const LobeRow& lobes);

}  // namespace kiln
