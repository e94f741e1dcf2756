// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "kiln/light/specular_chain.h"

namespace kiln {

/// How far each level of a chain is from the filtered sum it stands for, by brute force in double
/// at 24 texels spread over the cube: rms over them, relative to the environment's mean radiance.
/// Level 0, an average, is 0.
/// @param latlong  what the chain was made from
/// @return         [levels]
std::vector<double> chain_errors(const Layers& latlong, const SpecularChain& chain);

}  // namespace kiln
