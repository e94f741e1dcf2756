// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "openimageio_module.h"

namespace kiln::io {

/// The module's face; loads the module at the first call: from lib/kiln beside the folder of the
/// running program, else from the folder $KILN_MODULE_PATH.
/// @error Fault::Internal when it is not there or does not load
const module::Face& openimageio();

/// Why its last call on this thread failed, in one line.
std::string openimageio_error();

}  // namespace kiln::io
