// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "fit.h"

namespace kiln::validate {

/// A sheet read under some axes as integrals of some lobes.
struct Candidate {
  int sheet = 0;
  TableAxes axes;
  std::vector<ChannelFit> fits;
  double score = 1;
};

/// Equal for candidates that differ by alignments and shifts alone.
std::string class_of(const Candidate& candidate);

/// Score with a small handicap for odd conventions, so that plain ones win ties.
double handicapped(const Candidate& candidate);

/// Which lobes are tried.
enum class Effort { CommonLobes, AllLobes };

/// The best candidate of each class, best first: all axes, lobes and meanings on a few entries,
/// then all alignments for those that are left.
std::vector<Candidate> search(const std::vector<Sheet>& sheets, Effort effort);

/// The candidate with other alignments, of one axis at a time, that score best.
Candidate align(const Sheet& sheet, const Candidate& candidate, int entries);

/// The same with exact integrals, a step of one axis at a time.
Candidate settle(const Sheet& sheet, const Candidate& candidate, int entries);

/// A candidate compared with up to `most` entries a side.
struct Comparison {
  Reading reading;
  Places places;
  std::vector<std::vector<double>> exact;  ///< [channel][alpha][mu]
  std::vector<ChannelFit> fits;            ///< the candidate's, with their errors measured here
};
Comparison compare(const Sheet& sheet, const Candidate& candidate, int most);

}  // namespace kiln::validate
