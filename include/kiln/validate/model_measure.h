// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "kiln/table/lobe.h"

namespace kiln {

/// A least and a greatest value.
struct ValueRange {
  double least = 1, greatest = 1;
};

/// What a lobe does with energy, measured over roughness 0.1, 0.2, ... 1 and steep to grazing
/// directions (n.v from 1e-3 to 1).
struct LobeMeasure {
  /// The weak white furnace, INT G1(o, m) max(0, o.m) D(m) dm / mu_o: 1 for maskings that belong to
  /// a surface. Absent where there is no masking of one direction alone.
  std::optional<ValueRange> weak_furnace;
  double asymmetry = 0;          ///< greatest |f(i, o) - f(o, i)| / f(i, o); rounding if reciprocal
  double greatest_albedo = 0;    ///< with F = 1; above 1 the lobe gains energy
  double mu = 1, roughness = 1;  ///< where
};

/// Takes milliseconds. @accuracy 1e-3
/// @error Fault::Usage for names that are not on the lists or do not fit each other
LobeMeasure measure_lobe(const Lobe& lobe);

/// What a white diffuse model does with energy, over the same directions and roughness 0 to 1.
struct DiffuseMeasure {
  double greatest_albedo = 0;
  double mu = 1, roughness = 1;  ///< where
};

/// @error Fault::Usage for a name that is not on the list of diffuse models
DiffuseMeasure measure_diffuse(const std::string& model);

}  // namespace kiln
