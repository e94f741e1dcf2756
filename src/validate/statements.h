// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "judge.h"

namespace kiln::validate {

/// What is known of a table when statements are made.
struct Finding {
  const Sheet& sheet;
  const Candidate& candidate;
  const Comparison& comparison;
  const Match& match;
};

/// The smallest statements of what is wrong with a table that fits: shifts, encodings, swaps,
/// disagreement with its metadata, noise.
std::vector<std::string> statements_on(const Finding& finding);

/// The candidate as if no entries were shifted: what it was meant to be.
Candidate unshifted(Candidate candidate);

/// Entries that are no finite numbers, or empty.
std::string not_finite_statement(const Sheet& sheet);

}  // namespace kiln::validate
