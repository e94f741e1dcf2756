// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "kiln/bake/products.h"
#include "kiln/color/color.h"
#include "kiln/material/svbrdf.h"
#include "kiln/pipeline/report.h"

namespace kiln {

struct LoadedSet {
  Svbrdf svbrdf;
  SetRecord record;
};

/// Reads the maps of a set that its workflow needs, brings colours into the working space and
/// leaves numbers alone.
/// @error the set's own fault; Fault::Input naming every missing file at once, or the unreadable
/// one
///
/// @param wanted      so many texels each way are enough (Needs::material_for)
/// @param max_memory  [byte]; 0: no limit
LoadedSet load_set(const PlannedSet& set, const ColorChoice& color, const ColorConfig& config,
                   Size wanted, long long max_memory);

struct LoadedLight {
  LightMade made;
  EnvironmentRecord record;
};

/// Reads an environment and makes it ready to light with.
LoadedLight load_light(const EnvironmentChoice& environment, const ColorChoice& color,
                       const ColorConfig& config, const LightSettings& settings);

}  // namespace kiln
