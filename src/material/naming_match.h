// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "kiln/material/naming.h"

namespace kiln {

/// A token found in a name: scheme and token by their places in the lists.
struct TokenMatch {
  size_t scheme = 0;
  size_t token = 0;
};

/// The token that a file name without extension ends in: the last one, of those that end at the
/// same word the longest, then the one of the earliest scheme.
///
/// Short tokens and names of materials (`metal`, `rough`) count only where nothing but resolution,
/// UDIM tile and the like follows; a single letter must also stand alone: T_Rock_D, not Wood049D.
std::optional<TokenMatch> match_token(std::string_view stem,
                                      const std::vector<const NamingScheme*>& schemes);

}  // namespace kiln
