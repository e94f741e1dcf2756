// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "kiln/material/workflow.h"

namespace kiln {

/// How a normal map is stored: what has to be known before any of its rows can be decoded.
struct NormalForm {
  NormalDecoding decoding;  ///< nothing in it is Auto
  std::vector<std::string> notes, warnings;
};

/// Finds the form of a normal map from its first rows, or from all of them.
///
/// The convention is what is stated, else what the map's name says, else what the height map tells,
/// else OpenGL with a warning. Blue is z unless it is constant while red or green are not. Negative
/// values say that components are stored as they are.
class NormalSurvey {
 public:
  /// A map of more texels is judged by the first rows that hold so many and tell something.
  static constexpr long long enough_texels = 1LL << 20;

  /// @param map            the name of the source, and the convention that it says
  /// @param has_height     rows of a height map come beside those of the normals
  /// @param may_be_signed  floating-point samples
  NormalSurvey(const SlotMap& map, const WorkflowSettings& settings, bool has_height,
               bool may_be_signed);

  /// Rows below those before, of the normal map and of the height map resampled to its size.
  /// @error Fault::Input when the map has one channel only
  void add(const Layers& normal, const Plane* height);
  /// Whether more rows could tell more.
  bool is_open() const;
  NormalForm form() const;

 private:
  struct Extremes {
    float min = INFINITY, max = -INFINITY;
    bool constant() const { return max - min < 1e-6f; }
  };
  NormalDecoding decoding() const;
  bool asks_for_convention() const;

  std::string source_;
  NormalConvention named_;
  WorkflowSettings settings_;
  bool has_height_, may_be_signed_;
  bool has_third_ = true;
  long long texels_ = 0;
  std::array<Extremes, 3> extremes_;
  ConventionEvidence evidence_;
};

}  // namespace kiln
