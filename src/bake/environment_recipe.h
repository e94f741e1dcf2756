// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bakes.h"
#include "environment_presets.h"
#include "kiln/light/axes.h"
#include "kiln/light/chain_plan.h"
#include "kiln/light/prefilter.h"
#include "kiln/light/spherical_harmonics.h"

namespace kiln {

/// Everything about an environment to be made, decided.
struct EnvironmentRecipe {
  EnvironmentPreset preset;  ///< with plain names where none is chosen
  SphereLayout layout;
  std::string curve;
  ChainPlan plan;
  EnvironmentFormat format;
  std::string encoding;
  bool zstd;
  std::string distribution;
  double shape;
  Axes axes;
  std::string axes_text;
  int sh_order;
  ShWindow sh_window;

  SphereGrid grid(int size, double rotate_deg) const {
    return {layout, size, format.at_nodes, rotate_deg};
  }
  FilterLobe lobe(double alpha) const { return {distribution, alpha, shape}; }
};

/// What is given, else what the preset says, else the default.
/// @error Fault::Usage where they do not fit each other
EnvironmentRecipe resolve_environment(const EnvironmentBake::Settings& settings);

}  // namespace kiln
