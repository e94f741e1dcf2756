// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "kiln/brdf/schlick.h"

namespace kiln {

// What a specular lobe reflects in total, and how the rest of a surface makes room for it. These
// formulas need integrals of the lobe; they take them by value and never look anything up.

/// The split-sum terms of a lobe for one direction: it reflects F0 * scale + F90 * bias.
template <class F>
struct SplitSumTerms {
  F scale, bias;
  F total() const { return scale + bias; }  ///< E, the albedo with F = 1
};

/// The terms for the two directions of an evaluation and their cosine-weighted average.
template <class F>
struct Albedo {
  SplitSumTerms<F> o, i, average;
};

/// Colour of the light that bounces more than once between microfacets, per unit of light that the
/// single-bounce lobe loses: F_ms = F_avg^2 E_avg / (1 - F_avg (1 - E_avg)).
/// @source Kulla and Conty 2017, with the first bounce counted once (F_avg squared)
template <class F>
F multiple_scattering_color(F fresnel_average, F albedo_average) {
  return square(fresnel_average) * albedo_average /
         max(F(1) - fresnel_average * (F(1) - albedo_average), F(1e-7));
}

/// Multiple scattering of a microfacet lobe with F = 1 [1/sr]; reciprocal.
///
///     f_ms = (1 - E(mu_o))(1 - E(mu_i)) / (pi (1 - E_avg))
///
/// @source Kulla and Conty 2017; Kelemen and Szirmay-Kalos 2001
template <class F>
F multiple_scattering(const Albedo<F>& albedo) {
  const F lost_o = max(F(1) - albedo.o.total(), F(0));
  const F lost_i = max(F(1) - albedo.i.total(), F(0));
  const F lost_average = max(F(1) - albedo.average.total(), F(1e-6));
  return lost_o * lost_i / (F(pi) * lost_average);
}

/// One channel of a specular lobe with Schlick's Fresnel, as far as energy is concerned.
template <class F>
struct SpecularChannel {
  F f0, f90;
  F multiple;  ///< F_ms, 0 without multiple scattering

  /// Total reflectance for the direction of these terms.
  F reflectance(const SplitSumTerms<F>& terms) const {
    return fma(f0, terms.scale, fma(f90, terms.bias, multiple * (F(1) - terms.total())));
  }
};

/// Weight of a diffuse lobe under a specular one; reciprocal.
///
/// A lobe of constant albedo takes (1 - R(mu_i))(1 - R(mu_o)) / (1 - R_avg): then a white diffuse
/// colour makes the total 1 exactly. For any other lobe that quotient can exceed the energy there
/// is, so it takes min(1 - R(mu_i), 1 - R(mu_o)), which never reflects more than 1 - R(mu_o) of
/// the lobe's albedo. R is the reflectance of the channel with the greatest F0, for all channels
/// alike, so the diffuse colour keeps its hue.
///
/// @source Kelemen and Szirmay-Kalos 2001 (exact form)
template <class F>
F coupling(const SpecularChannel<F>& greatest, const Albedo<F>& albedo, bool constant_albedo) {
  const F left_o = clamp(F(1) - greatest.reflectance(albedo.o), F(0), F(1));
  const F left_i = clamp(F(1) - greatest.reflectance(albedo.i), F(0), F(1));
  if (!constant_albedo) return min(left_o, left_i);
  const F left_average = max(F(1) - greatest.reflectance(albedo.average), F(1e-6));
  return left_o * left_i / left_average;
}

// What is done about the light that bounces between microfacets, as models on a list. Each says,
// for one channel, what multiplies the single-bounce BRDF, what is added to it [1/sr], and what the
// lobe then reflects in total.

/// What these models read of one channel.
template <class F>
struct ChannelEnergy {
  F f0;               ///< reflectance at normal incidence
  F fresnel_average;  ///< F_avg over the hemisphere
  F reflectance;      ///< R(mu_o), albedo of the single-bounce lobe with its Fresnel
};

/// The lobe as it is: rough metals darken.
template <class F>
struct SingleBounce {
  static constexpr std::string_view name = "none";
  static constexpr std::string_view summary = "first bounce only: rough metals darken";
  static constexpr std::string_view source = "Torrance & Sparrow 1967";
  static constexpr bool reciprocal = true;

  static F scale(const ChannelEnergy<F>&, const Albedo<F>&) { return F(1); }
  static F added(const ChannelEnergy<F>&, const Albedo<F>&) { return F(0); }
  static F total(const ChannelEnergy<F>& channel, const Albedo<F>&) { return channel.reflectance; }
};

/// A lobe of its own for what the first bounce loses, coloured by F_avg: see multiple_scattering.
template <class F>
struct KullaConty {
  static constexpr std::string_view name = "kulla-conty";
  static constexpr std::string_view summary = "reciprocal lobe for what the first bounce loses";
  static constexpr std::string_view source = "Kulla & Conty 2017, F_avg squared";
  static constexpr bool reciprocal = true;

  static F color(const ChannelEnergy<F>& channel, const Albedo<F>& albedo) {
    return multiple_scattering_color(channel.fresnel_average, albedo.average.total());
  }
  static F scale(const ChannelEnergy<F>&, const Albedo<F>&) { return F(1); }
  static F added(const ChannelEnergy<F>& channel, const Albedo<F>& albedo) {
    return color(channel, albedo) * multiple_scattering(albedo);
  }
  static F total(const ChannelEnergy<F>& channel, const Albedo<F>& albedo) {
    return fma(color(channel, albedo), F(1) - albedo.o.total(), channel.reflectance);
  }
};

/// The lobe scaled up: 1 + F0 (1 - E(mu_o)) / E(mu_o). Not reciprocal.
template <class F>
struct Turquin {
  static constexpr std::string_view name = "turquin";
  static constexpr std::string_view summary = "lobe scaled by 1 + F0 (1/E - 1); not reciprocal";
  static constexpr std::string_view source = "Turquin 2019";
  static constexpr bool reciprocal = false;

  static F scale(const ChannelEnergy<F>& channel, const Albedo<F>& albedo) {
    const F e = albedo.o.total();
    return fma(channel.f0, (F(1) - e) / max(e, F(1e-6)), F(1));
  }
  static F added(const ChannelEnergy<F>&, const Albedo<F>&) { return F(0); }
  static F total(const ChannelEnergy<F>& channel, const Albedo<F>& albedo) {
    return channel.reflectance * scale(channel, albedo);
  }
};

/// A diffuse lobe for what the first bounce loses, meant for light from everywhere:
/// R F_avg / (1 - F_avg (1 - E)) (1 - E) with R and E those of mu_o. Not reciprocal.
template <class F>
struct FdezAguera {
  static constexpr std::string_view name = "fdez-aguera";
  static constexpr std::string_view summary = "diffuse lobe for what is lost; not reciprocal";
  static constexpr std::string_view source = "Fdez-Aguera 2019";
  static constexpr bool reciprocal = false;

  static F lost(const ChannelEnergy<F>& channel, const Albedo<F>& albedo) {
    const F missing = F(1) - albedo.o.total();
    return channel.reflectance * channel.fresnel_average * missing /
           max(F(1) - channel.fresnel_average * missing, F(1e-7));
  }
  static F scale(const ChannelEnergy<F>&, const Albedo<F>&) { return F(1); }
  static F added(const ChannelEnergy<F>& channel, const Albedo<F>& albedo) {
    return lost(channel, albedo) * F(1 / pi);
  }
  static F total(const ChannelEnergy<F>& channel, const Albedo<F>& albedo) {
    return channel.reflectance + lost(channel, albedo);
  }
};

// How a diffuse lobe makes room for the specular one above it, as models on a list: the weight of
// the diffuse lobe.

/// See coupling.
template <class F>
struct ReciprocalCoupling {
  static constexpr std::string_view name = "reciprocal";
  static constexpr std::string_view summary = "diffuse lobe weighted by what both directions leave";
  static constexpr std::string_view source = "Kelemen & Szirmay-Kalos 2001";
  static constexpr bool reciprocal = true;

  static F weight(const SpecularChannel<F>& greatest, const Albedo<F>& albedo,
                  bool constant_albedo) {
    return coupling(greatest, albedo, constant_albedo);
  }
};

/// 1 - R(mu_o): exact for any diffuse lobe, and not reciprocal.
template <class F>
struct AlbedoScaling {
  static constexpr std::string_view name = "albedo-scaling";
  static constexpr std::string_view summary = "diffuse lobe times 1 - R(mu_o); not reciprocal";
  static constexpr std::string_view source = "OpenPBR; MaterialX";
  static constexpr bool reciprocal = false;

  static F weight(const SpecularChannel<F>& greatest, const Albedo<F>& albedo, bool) {
    return clamp(F(1) - greatest.reflectance(albedo.o), F(0), F(1));
  }
};

}  // namespace kiln
