// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "kiln/brdf/beckmann.h"
#include "kiln/brdf/burley.h"
#include "kiln/brdf/charlie.h"
#include "kiln/brdf/conductor.h"
#include "kiln/brdf/dielectric.h"
#include "kiln/brdf/energy.h"
#include "kiln/brdf/eon.h"
#include "kiln/brdf/estevez_kulla.h"
#include "kiln/brdf/f82.h"
#include "kiln/brdf/fujii.h"
#include "kiln/brdf/ggx.h"
#include "kiln/brdf/gtr.h"
#include "kiln/brdf/gulbrandsen.h"
#include "kiln/brdf/hammon_diffuse.h"
#include "kiln/brdf/hammon_masking.h"
#include "kiln/brdf/implicit.h"
#include "kiln/brdf/kelemen.h"
#include "kiln/brdf/lambert.h"
#include "kiln/brdf/lazanyi.h"
#include "kiln/brdf/neubelt.h"
#include "kiln/brdf/neumann.h"
#include "kiln/brdf/oren_nayar.h"
#include "kiln/brdf/phong.h"
#include "kiln/brdf/schlick.h"
#include "kiln/brdf/schlick_masking.h"
#include "kiln/brdf/smith.h"
#include "kiln/brdf/student_t.h"
#include "kiln/brdf/unreal_joint.h"
#include "kiln/brdf/v_cavity.h"
#include "kiln/core/names.h"

namespace kiln {

/// A closed list of models, each a template on the number type. Parsing, help, docs and the
/// contract tests follow from the lists below: a new model is one file and one line here.
template <template <class> class... Models>
struct ModelList {
  /// Calls visit.operator()<Model>() for each model in order.
  template <class Visit>
  static void for_each(Visit&& visit) {
    (visit.template operator()<Models>(), ...);
  }
};

using Distributions = ModelList<Ggx, Beckmann, Phong, Gtr, StudentT, Charlie>;
using Maskings = ModelList<SmithCorrelated, SmithSeparable, VCavity, Kelemen, Implicit, Neumann,
                           SchlickBeckmann, SchlickGgx, SchlickGgxDirect, HammonMasking,
                           UnrealJoint, Neubelt, NeubeltClamped, EstevezKulla>;
using Fresnels =
    ModelList<Schlick, Dielectric, Conductor, F82Tint, HoffmanF82, Gulbrandsen, Lazanyi>;
using Diffuses = ModelList<Lambert, Eon, Burley, OrenNayar, Fujii, HammonDiffuse>;
using Energies = ModelList<KullaConty, Turquin, FdezAguera, SingleBounce>;
using Couplings = ModelList<ReciprocalCoupling, AlbedoScaling>;

/// What there is to say about a model. Flags are absent where they mean nothing for the family.
struct ModelFacts {
  std::string family;  ///< "distribution", "masking", "fresnel", "diffuse", "energy", "coupling"
  std::string name;
  std::string summary;
  std::string source;
  std::vector<ModelParam> params = {};
  std::optional<bool> reciprocal = {};         ///< directions may be swapped
  std::optional<bool> anisotropic = {};        ///< two widths
  std::optional<bool> has_lambda = {};         ///< Smith's masking fits
  std::optional<bool> exact_lambda = {};       ///< of this distribution, not borrowed
  std::optional<bool> one_sided = {};          ///< the masking of one direction alone is defined
  std::optional<double> greatest_albedo = {};  ///< of a white diffuse surface; above 1 gains energy
};

/// Every model of every list.
const std::vector<ModelFacts>& all_models();

/// Names of one family, in the order of its list.
std::vector<std::string> model_names(std::string_view family);

/// Names of the maskings that fit a listed distribution, in the order of their list.
std::vector<std::string> fitting_maskings(std::string_view distribution);

/// A distribution of these widths; shape 0 is the model's default, and is not read by models
/// without one.
template <class Distribution, class F>
Distribution make_distribution(F alpha_x, F alpha_y, double shape) {
  if constexpr (requires { Distribution::default_shape; }) {
    return Distribution::make(alpha_x, alpha_y,
                              F(shape == 0 ? Distribution::default_shape : shape));
  } else {
    return Distribution::make(alpha_x, alpha_y, F(0));
  }
}

/// Whether a masking model has what it needs of a distribution.
template <template <class> class Distribution, template <class> class Masking>
inline constexpr bool fits_together = Masking<double>::template fits<Distribution<double>>;

/// Calls visit.operator()<Distribution, Masking>() for each pair that fits together.
template <class Visit>
void for_each_lobe(Visit&& visit) {
  Distributions::for_each([&]<template <class> class Distribution>() {
    Maskings::for_each([&]<template <class> class Masking>() {
      if constexpr (fits_together<Distribution, Masking>) {
        visit.template operator()<Distribution, Masking>();
      }
    });
  });
}

/// Throws Fault::Usage: one of the names is not on its list, or the masking does not fit.
[[noreturn]] void refuse_lobe(std::string_view distribution, std::string_view masking);

/// Calls visit.operator()<Distribution, Masking>() for the pair of those names.
/// @error Fault::Usage, naming the nearest known names or the maskings that fit
template <class Visit>
void with_lobe(std::string_view distribution, std::string_view masking, Visit&& visit) {
  const std::string wanted_distribution = kebab(distribution), wanted_masking = kebab(masking);
  bool found = false;
  for_each_lobe([&]<template <class> class Distribution, template <class> class Masking>() {
    if (Distribution<double>::name != wanted_distribution) return;
    if (Masking<double>::name != wanted_masking) return;
    found = true;
    visit.template operator()<Distribution, Masking>();
  });
  if (!found) refuse_lobe(distribution, masking);
}

}  // namespace kiln
