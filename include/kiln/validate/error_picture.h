// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "kiln/validate/verify.h"

namespace kiln {

/// The errors of a table to look at: the channels side by side, red where the table holds too much,
/// blue where too little, white where it is exact; full colour is the greatest error. Small tables
/// are enlarged by whole factors.
/// @return planes R G B [0..1], to be shown as they are
Layers error_picture(const Verdict& verdict);

}  // namespace kiln
