// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "kiln/brdf/model_param.h"
#include "kiln/math/vec.h"

namespace kiln {

// A Fresnel model is the reflectance of one colour channel as a function of the cosine at the
// microfacet. Each is made of the same record, of which it reads what it needs.

/// What a user says about a channel, by name; see the parameters of each model.
template <class F>
struct FresnelChannel {
  F f0 = F(0.04);       ///< reflectance at normal incidence [0..1]
  F f90 = F(1);         ///< reflectance at grazing incidence [0..1]
  F f82 = F(1);         ///< at the cosine 1/7: a tint of Schlick's, or the reflectance itself
  F edge_tint = F(0);   ///< Gulbrandsen's g [0..1]
  F ior = F(1.5);       ///< n, relative index of refraction
  F extinction = F(0);  ///< k
  F dip = F(0);         ///< Lazanyi's a
  F exponent = F(6);    ///< Lazanyi's exponent
};

inline constexpr ModelParam f0_param{"f0", 0, 1, 0.04, "reflectance at normal incidence"};
inline constexpr ModelParam f90_param{"f90", 0, 1, 1, "reflectance at grazing incidence"};
inline constexpr ModelParam ior_param{"ior", 0.05, 20, 1.5, "relative index of refraction n"};
inline constexpr ModelParam extinction_param{"extinction", 0, 20, 0, "extinction coefficient k"};

/// The cosine 1/7 (about 82 degrees), where metals dip before they rise.
inline constexpr double cosine_82 = 1.0 / 7;

/// (1 - c)^5, the weight of F90 in Schlick's form.
template <class F>
F grazing_weight(F cosine) {
  return pow5(clamp(F(1) - cosine, F(0), F(1)));
}

/// Gauss-Legendre in sqrt(c), twelve points, weighted by 2 c dc.
inline constexpr std::array<double, 12> fresnel_cosines = {
    0.0000850025523458157339, 0.00229837513148131111, 0.0132361948357330746, 0.0425766177135455917,
    0.0999092534147219623,    0.191304147396115656,   0.316537555907584571,  0.467740752412902156,
    0.629894572000163039,     0.783138869030037762,   0.906415631501956168,  0.981645636799065066};
inline constexpr std::array<double, 12> fresnel_weights = {
    7.39422992269757696e-8, 0.0000235667019398403876, 0.000487536644119924146,
    0.00356977474554350463, 0.0147472678845082456,    0.0416938803606985762,
    0.088740854182789154,   0.149386314757248479,     0.203135522009989154,
    0.221881302164233442,   0.184568897478397106,     0.0917650091282333468};

/// Average of a reflectance over the hemisphere of directions, 2 INT F(c) c dc, by quadrature.
/// @accuracy exact for polynomials of c up to degree 10; elsewhere as the model states
template <class F, class Model>
F fresnel_average(const Model& model) {
  F sum = F(0);
  for (size_t k = 0; k < fresnel_cosines.size(); ++k) {
    sum = fma(F(fresnel_weights[k]), model.eval(F(fresnel_cosines[k])), sum);
  }
  return sum;
}

/// Three channels of one Fresnel model.
template <class Model>
struct PerChannel {
  Model x, y, z;

  template <class F>
  static PerChannel make(const FresnelChannel<F>& x, const FresnelChannel<F>& y,
                         const FresnelChannel<F>& z) {
    return {Model::make(x), Model::make(y), Model::make(z)};
  }

  /// @return [0..1] per channel
  template <class F>
  Vec3<F> eval(F cosine) const {
    return {x.eval(cosine), y.eval(cosine), z.eval(cosine)};
  }

  /// Average over the hemisphere of directions, per channel.
  auto average() const {
    return Vec3<decltype(x.average())>{x.average(), y.average(), z.average()};
  }
};

}  // namespace kiln
