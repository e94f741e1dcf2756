// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "kiln/pipeline/plan.h"

namespace kiln {

/// The texture sets that the entries of `sets` come to; warnings go to the plan.
void plan_sets(const Pipeline& pipeline, Plan& plan, Mistakes& mistakes);

}  // namespace kiln
