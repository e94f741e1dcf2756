// SPDX-License-Identifier: Apache-2.0
#include "kiln/table/channel.h"

#include <fmt/format.h>

#include <algorithm>

#include "channel_lists.h"
#include "kiln/brdf/roughness.h"
#include "kiln/core/error.h"
#include "kiln/core/names.h"

namespace kiln {
namespace {

std::vector<ChannelFacts> make_list() {
  std::vector<ChannelFacts> list;
  add_lobe_channels(list);
  add_diffuse_channels(list);
  add_anisotropic_channels(list);
  add_glass_channels(list);
  add_ltc_channels(list);
  add_skin_channels(list);
  return list;
}

std::string key_of(const Lobe& lobe, const FresnelChoice& fresnel) {
  const FresnelChannel<double>& p = fresnel.parameters;
  return fmt::format("{} {} {} {} {} {} {} {} {} {} {} {}", lobe.distribution, lobe.masking,
                     lobe.shape, fresnel.name, p.f0, p.f90, p.f82, p.ior, p.extinction, p.edge_tint,
                     p.dip, p.exponent);
}

}  // namespace

LobeIntegrals& LobeCache::of(const Lobe& lobe, const FresnelChoice& fresnel) {
  const std::string key = key_of(lobe, fresnel);
  auto found = lobes_.find(key);
  if (found == lobes_.end()) {
    found = lobes_.emplace(key, Held{LobeIntegrals(lobe, fresnel, quality_, floor_mu_)}).first;
  }
  found->second.used = true;
  return found->second.lobe;
}

void LobeCache::keep() {
  for (auto& [key, held] : lobes_) held.kept = true;
}

void LobeCache::drop_unused() {
  std::erase_if(lobes_, [](const auto& entry) { return !entry.second.used && !entry.second.kept; });
  for (auto& [key, held] : lobes_) held.used = false;
}

const std::vector<ChannelFacts>& all_channels() {
  static const std::vector<ChannelFacts> channels = make_list();
  return channels;
}

const ChannelFacts& find_channel(const std::string& name) {
  std::vector<std::string> known;
  for (const ChannelFacts& channel : all_channels()) {
    const bool alias = std::count(channel.aliases.begin(), channel.aliases.end(), kebab(name)) > 0;
    if (alias || channel.name == kebab(name)) return channel;
    known.push_back(channel.name);
  }
  throw Error(Fault::Usage, unknown_name("channel", name, known));
}

double table_alpha(double roughness) { return roughness <= 0 ? 0 : to_alpha(roughness); }

}  // namespace kiln
