// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "kiln/table/channel.h"

namespace kiln {

// Each adds its channels to the list in channel.cpp.
void add_lobe_channels(std::vector<ChannelFacts>& list);
void add_diffuse_channels(std::vector<ChannelFacts>& list);
void add_anisotropic_channels(std::vector<ChannelFacts>& list);
void add_glass_channels(std::vector<ChannelFacts>& list);
void add_ltc_channels(std::vector<ChannelFacts>& list);
void add_skin_channels(std::vector<ChannelFacts>& list);

/// The planes kept in the context under that key, made by `make` the first time.
template <class Make>
const std::vector<std::vector<double>>& shared_planes(TableContext& context, const char* key,
                                                      Make&& make) {
  const auto found = context.shared.find(key);
  if (found != context.shared.end()) return found->second;
  return context.shared.emplace(key, make(context)).first->second;
}

}  // namespace kiln
