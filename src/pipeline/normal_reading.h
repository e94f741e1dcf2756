// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "kiln/material/normal_survey.h"
#include "kiln/pipeline/plan.h"

namespace kiln {

/// How a normal map of the set is stored, by as many of its rows as it takes. A height map of the
/// set is opened only where it alone can tell how the normals are meant, and read beside them.
NormalForm normal_form(const PlannedSet& set, const PlannedMap& normal);

}  // namespace kiln
