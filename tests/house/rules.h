// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "house.h"

namespace kiln::test {

/// What breaks a rule, one line each: "file:line: what was found, what is allowed".
using Breaches = std::vector<std::string>;

Breaches includes_that_the_plan_forbids(const House& house);
Breaches arrows_that_point_up(const House& house);
Breaches rooms_in_a_cycle(const House& house);
Breaches rooms_missing_from_plan_or_disk(const House& house);
Breaches rooms_drawn_otherwise(const House& house);
Breaches third_party_headers_outside_their_room(const House& house);
Breaches third_party_types_in_public_headers(const House& house);
Breaches files_without_licence_line(const House& house);
Breaches files_with_forbidden_names(const House& house);
Breaches exits_and_prints_outside_the_command(const House& house);
Breaches catches_away_from_the_doors(const House& house);
Breaches fast_math_flags(const House& house);

/// A report, not a rule: files of src and include with more than `limit` lines.
Breaches files_longer_than(const House& house, size_t limit);

}  // namespace kiln::test
