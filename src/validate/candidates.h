// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "kiln/table/lobe.h"

namespace kiln::validate {

/// A lobe whose integrals a table may hold.
struct TriedLobe {
  Lobe lobe;
  bool sheen = false;  ///< matched channel by channel, beside any specular lobe
  bool rare = false;   ///< tried where no other explains a table
};

/// Every lobe worth trying: GGX with height-correlated Smith masking first. Distributions with a
/// shape of their own are left out, for with some shapes they are others on the list.
const std::vector<TriedLobe>& tried_lobes();

/// What a channel may hold of a lobe at (mu, alpha), or without one.
enum class Meaning {
  Scale,
  Bias,
  Albedo,
  Loss,
  Edge,
  EdgeTimesSixteen,
  AlbedoOverTwoPi,
  BiasOverTwoPi,
  Burley,
  BurleyLessHalf,
  UnityDisney,
  FabricLambert,
  SphereFormFactor,
};

std::string_view words(Meaning meaning);

std::span<const Meaning> meanings_of_specular();
std::span<const Meaning> meanings_of_sheen();
std::span<const Meaning> meanings_without_lobe();

/// @param terms  of the lobe there; not used for those without one
double value_of(Meaning meaning, const LobeTerms& terms, double mu, double alpha);

}  // namespace kiln::validate
