// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "kiln/table/channel.h"

namespace kiln {

// Each adds its channels to the list in channel.cpp.
void add_lobe_channels(std::vector<ChannelFacts>& list);
void add_diffuse_channels(std::vector<ChannelFacts>& list);

}  // namespace kiln
