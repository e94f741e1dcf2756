// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "kiln/table/lobe.h"

namespace kiln::validate {

/// A lobe whose integrals a table may hold.
struct Model {
  Lobe lobe;
  bool sheen = false;  ///< matched channel by channel, beside any specular lobe
};

/// Every lobe worth trying: GGX with height-correlated Smith masking first.
const std::vector<Model>& all_models();

/// What a channel may hold of a lobe at (mu, alpha), or of a diffuse model.
enum class Meaning {
  Scale,
  Bias,
  Albedo,
  Loss,
  ClampedAlbedo,
  AlbedoOverTwoPi,
  BiasOverTwoPi,
  Burley,
  BurleyLessHalf,
};

std::string_view words(Meaning meaning);

std::span<const Meaning> meanings_of_specular();
std::span<const Meaning> meanings_of_sheen();
std::span<const Meaning> meanings_of_diffuse();

/// @param terms  of the lobe there; not used for the diffuse ones
double value_of(Meaning meaning, const SplitSumTerms<double>& terms, double mu, double alpha);

}  // namespace kiln::validate
