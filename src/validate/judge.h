// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "search.h"

namespace kiln::validate {

/// Errors of a channel over the entries compared.
struct ChannelErrors {
  double rms = 0, greatest = 0, spread = 0;  ///< spread: standard deviation of what is stored
  size_t worst = 0;                          ///< entry of the greatest, [alpha][mu]
  bool known = false;
};
std::vector<ChannelErrors> errors_of(const Comparison& comparison);

/// Root of the mean of squares over channels that are known.
double rms_of_known(const std::vector<ChannelErrors>& errors);

/// The match in words and figures.
/// @param named  channels to name though they are not known, for comparison with others
Match describe(const Sheet& sheet, const Candidate& candidate, const Comparison& comparison,
               const std::vector<ChannelErrors>& named = {});

/// Whether the best candidate is what the table holds: it explains every channel, or some of them
/// very well, and explains them clearly better than candidates of other classes do.
bool acceptable(const Sheet& sheet, const std::vector<ChannelErrors>& errors, double ratio);

/// The same channels under another candidate: how much greater its rms error is.
double ratio_between(const std::vector<ChannelErrors>& best, const Candidate& best_candidate,
                     const Candidate& other);

/// stored - exact of known channels, in the table's own arrangement.
Layers error_layers(const Sheet& sheet, const Candidate& candidate, const Comparison& comparison);

}  // namespace kiln::validate
