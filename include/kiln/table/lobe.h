// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "kiln/brdf/energy.h"
#include "kiln/brdf/models.h"
#include "kiln/table/view_rule.h"

namespace kiln {

/// A specular lobe by the names of its models.
struct Lobe {
  std::string distribution = "ggx";
  std::string masking = "smith-correlated";
  double shape = 0;  ///< of distributions that have one; 0 is the model's default
};

/// What a Fresnel term makes of a lobe.
struct FresnelChoice {
  std::string name;  ///< a Fresnel model, a share, or empty for Schlick's terms apart
  FresnelChannel<double> parameters = {};
};

/// Names of two more terms, which are no models: the share of F90, F = F0 + share (F90 - F0), of a
/// dielectric by its `ior` and of Schlick's form with any `exponent`.
inline constexpr const char* dielectric_share = "dielectric share";
inline constexpr const char* schlick_share = "schlick share";

/// In place of a masking: none but that of the viewer (Smith's), so that integrals are means over
/// visible normals.
inline constexpr const char* visible_normals = "visible normals";

/// How far a quadrature goes. GGX with Smith masking errs by 2e-8 at Table, 1e-9 at Check, 1e-11 at
/// Exact, 1e-12 at Beyond, which only checks the others. Maskings with kinks err more.
enum class Quality { Table, Check, Exact, Beyond };
/// The next better one, against which errors are measured.
Quality finer(Quality quality);

/// Integrals of a lobe toward one direction. With Schlick's terms apart:
///
///     scale = INT (1 - Fc),  bias = INT Fc,  edge = INT c (1 - c)^6,     Fc = (1 - c)^5
///
/// so that F0 * scale + F90 * bias is the reflectance, and a term -a c (1 - c)^6 (Hoffman 2019)
/// takes a * edge off. With a Fresnel model, `scale` is the reflectance and the rest is 0.
struct LobeTerms {
  double scale = 0, bias = 0, edge = 0;
  double total() const { return scale + bias; }  ///< E, or the reflectance
};

/// A direction and the widths of a lobe.
struct LobePoint {
  double mu = 1;       ///< [1e-4, 1], clamped
  double alpha_x = 1;  ///< [1e-4, 1]; 0 is the limit of a mirror
  double alpha_y = 1;
  double azimuth = 0;  ///< of the direction, from the x axis [rad]
};

/// How a grid is filled.
enum class GridMeans {
  Quadrature,  ///< an integral an entry
  Field        ///< between Chebyshev nodes, where lobes are smooth enough
};

class SmoothField;

/// Integrals of one lobe. Large grids of smooth lobes are interpolated between Chebyshev nodes,
/// which costs less than an integral an entry and keeps the accuracy.
class LobeIntegrals {
 public:
  /// @param floor_mu  the least cosine that grids will ask for
  /// @error Fault::Usage for names that are not on the lists or do not fit each other
  LobeIntegrals(const Lobe& lobe, const FresnelChoice& fresnel, Quality quality,
                double floor_mu = least_mu);
  ~LobeIntegrals();
  LobeIntegrals(LobeIntegrals&&) noexcept;
  LobeIntegrals& operator=(LobeIntegrals&&) noexcept;

  LobeTerms at(const LobePoint& point) const;
  /// Isotropic, [alpha][mu].
  std::vector<LobeTerms> grid(std::span<const double> mus, std::span<const double> alphas);
  /// The same by given means: with those of a whole grid, part of it is the same to the bit.
  std::vector<LobeTerms> grid(std::span<const double> mus, std::span<const double> alphas,
                              GridMeans means);
  /// What grid() does with these.
  GridMeans means_for(std::span<const double> mus, std::span<const double> alphas) const;
  /// Average over directions, 2 INT_0^1 E(mu) mu dmu.
  LobeTerms average(double alpha) const;

 private:
  struct Work;
  std::unique_ptr<Work> work_;
};

/// Split-sum terms on a grid, [alpha][mu].
std::vector<SplitSumTerms<double>> integrate_grid(const Lobe& lobe, std::span<const double> mus,
                                                  std::span<const double> alphas, Quality quality);

}  // namespace kiln
