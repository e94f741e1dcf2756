// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "kiln/validate/verify.h"

namespace kiln::validate {

/// One axis of a table: what it holds, from which end it counts, where entries lie.
template <class Map>
struct AxisReading {
  Map map{};
  bool reversed = false;
  Placement alignment;
};

/// Cosines or alphas at these entries of n, for an axis that holds them so.
std::vector<double> positions(const AxisReading<CosineAxis>& axis, int n,
                              const std::vector<int>& entries);
std::vector<double> positions(const AxisReading<WidthAxis>& axis, int n,
                              const std::vector<int>& entries);

AxisReading<CosineAxis> cosine_axis(const TableAxes& axes);
AxisReading<WidthAxis> width_axis(const TableAxes& axes);

/// All axes with centred entries; flips of an axis included.
std::vector<TableAxes> all_axes();

/// The alignments that are tried: centres, nodes, half and whole entries beside them.
const std::vector<Placement>& all_alignments();

/// Entries at the centres, or from end to end.
inline constexpr Placement centres{0.5, false}, nodes{0.0, true};
inline bool plain(const Placement& alignment) { return alignment == centres || alignment == nodes; }

std::string words(const AxisReading<CosineAxis>& axis);
std::string words(const AxisReading<WidthAxis>& axis);
std::string words(const Placement& alignment);
/// "x = n.v, y = roughness (alpha = roughness^2); entries at centres (i + 1/2) / N"
std::string words(const TableAxes& axes);

}  // namespace kiln::validate
