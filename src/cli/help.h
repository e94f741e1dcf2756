// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "verb.h"

namespace kiln {

/// Name of the group of options that every verb has; the help tells them in short at its end.
inline constexpr const char* every_verb = "every verb";

/// Of options that choose a surface's models; the help names them, `kiln list surface` tells more.
inline constexpr const char* of_the_surface = "of the surface";

/// Of options that say how an environment is read, where it is not the verb's own subject; the help
/// names them, that of `kiln env` tells more.
inline constexpr const char* of_the_environment = "of the environment";

/// What there is: every verb on a line, and the exit codes.
std::string overview();

/// Arguments and options of one verb, wrapped to 100 columns.
std::string help_of(const Verb& verb, const CLI::App& app);

}  // namespace kiln
