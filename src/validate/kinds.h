// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "kiln/table/channel.h"

namespace kiln::validate {

/// What an entry of a kind may hold.
struct Content {
  std::string words;  ///< "entering: reflected and let through"
  std::vector<double> (*fill)(TableContext&) = nullptr;
};

/// A kind of table beside integrals of a lobe over n.v and roughness: its quantities in the order
/// in which contents are filled (the first runs fastest), each with the mappings that are tried.
struct Kind {
  std::string table;  ///< its class: "glass"
  std::vector<std::vector<const AxisMapping*>> axes;
  std::vector<Content> contents;
  /// What some tables hold where the last quantity or roughness is at its least: glass that does
  /// not refract, or is smooth, loses nothing.
  std::optional<double> limit = {};
};

/// Kinds of two axes, then those of three.
const std::vector<Kind>& all_kinds();

/// Coordinates of each quantity of a kind, in its order.
using Coordinates = std::vector<std::vector<double>>;

/// Exact values of these contents, [content][last quantity]...[first quantity]; to 1e-6.
std::vector<std::vector<double>> fill_contents(const Kind& kind, const Coordinates& coordinates,
                                               const std::vector<int>& contents);

}  // namespace kiln::validate
