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
  int specular = 0;  ///< on all_models(): what channels that hold no sheen and no diffuse are of
  std::vector<ChannelFit> fits;
  double score = 1;
};

/// Equal for candidates that differ by alignments and shifts alone.
std::string class_of(const Candidate& candidate);

/// Score with a small handicap for odd conventions, so that plain ones win ties.
double handicapped(const Candidate& candidate);

/// The best candidate of each class, best first: all axes, lobes and meanings on a few entries,
/// then all alignments for those that are left. At most `most`.
std::vector<Candidate> search(const std::vector<Sheet>& sheets, size_t most);

/// The candidate with other alignments, of one axis at a time, that score best.
Candidate align(const Sheet& sheet, const Candidate& candidate, int entries);

/// A candidate compared with up to `most` entries a side.
struct Comparison {
  Reading reading;
  Places places;
  std::vector<std::vector<double>> exact;  ///< [channel][alpha][mu]
  std::vector<ChannelFit> fits;            ///< the candidate's, with their errors measured here
};
Comparison compare(const Sheet& sheet, const Candidate& candidate, int most);

}  // namespace kiln::validate
