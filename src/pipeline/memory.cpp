// SPDX-License-Identifier: Apache-2.0
#include "memory.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "kiln/io/image_rows.h"
#include "kiln/parallel/threads.h"
#include "map_opening.h"
#include "outputs.h"

namespace kiln {
namespace {

constexpr long long mebibyte = 1LL << 20;
constexpr long long process_bytes = 190 * mebibyte;  // with the libraries that decode images
constexpr double freed_and_kept = 1.6;  // memory of bands, with what the allocator has not returned
constexpr long long most_of_plane = mebibyte / 4;
constexpr int rows_of_block = 64;  // that decoders give at once

// "1.5 GiB", "300 MiB"
std::string text_of(long long bytes) {
  const double mib = static_cast<double>(bytes) / static_cast<double>(mebibyte);
  return mib >= 1024 ? fmt::format("{:.2f} GiB", mib / 1024) : fmt::format("{:.0f} MiB", mib);
}

RowCost cost_of_material(const SetCost& set) {
  return {set.size.width, 1.0 * set.planes, 2.0 * set.planes, set.planes, set.held};
}

bool is_of_anisotropy(Slot slot) {
  return slot == Slot::Anisotropy || slot == Slot::AnisotropyAngle;
}

// What of a file stays in memory: its bytes, or some of them, and all texels of those that cannot
// be read row by row.
long long bytes_held(const PlannedMap& map, const FileFacts& facts, size_t channels) {
  const bool is_embedded = map.embedded.bytes != nullptr;
  const long long file = is_embedded ? static_cast<long long>(map.embedded.bytes->size())
                                     : bytes_kept(map.path, facts);
  if (!is_embedded && !is_held_whole(facts)) return file;
  return file + 4LL * area(facts.size) * static_cast<long long>(channels);
}

}  // namespace

long long bytes_of(const RowCost& cost, const BandPlan& bands) {
  const long long decoding = 5LL * cost.width * cost.channels * rows_of_block;
  const double planes =
      cost.planes * bands.at_once + cost.working * std::min(bands.at_once, available_threads());
  return process_bytes + decoding + cost.held +
         static_cast<long long>(4.0 * static_cast<double>(cost.width) * bands.rows * planes);
}

BandPlan plan_bands(const RowCost& cost, long long budget) {
  BandPlan bands;
  // Planes of bands that are larger than the caches near a core are slower, and no better.
  while (bands.rows > band_unit && 4 * cost.width * bands.rows > most_of_plane) bands.rows /= 2;
  if (budget <= 0) return bands;
  while (bands.at_once > 2 && bytes_of(cost, bands) > budget) --bands.at_once;
  while (bands.rows > band_unit && bytes_of(cost, bands) > budget) bands.rows /= 2;
  bands.at_once = bytes_of(cost, bands) > budget ? 1 : bands.at_once;
  return bands;
}

BandPlan require_bands(const RowCost& cost, long long budget) {
  const BandPlan bands = plan_bands(cost, budget);
  require_memory(bytes_of(cost, bands), budget, fmt::format("a band of {} rows", bands.rows));
  return bands;
}

SetCost cost_of_set(const PlannedSet& set, const MapNeeds& needs) {
  SetCost cost;
  std::set<std::filesystem::path> seen;
  const std::vector<PlannedMap> maps = maps_needed(set, needs);
  for (const PlannedMap& map : maps) {
    cost.planes += is_of_anisotropy(map.slot);
    if (map.path.empty() || !seen.insert(map.path).second) continue;
    const FileFacts facts = facts_of_file(map);
    if (area(facts.size) > area(cost.size)) cost.size = facts.size;
    cost.channels += static_cast<int>(facts.channels.size());
    cost.held += bytes_held(map, facts, wanted_channels(map.path, facts, maps).size());
  }
  return cost;
}

RowCost cost_of_rows(const Plan& plan, const Task& task) {
  const MapNeeds& needs = task.needs.maps;
  const SetCost set = cost_of_set(plan.sets[*task.set], needs);
  const bool keeps_view = task.needs.late_view && is_for_viewing(task.out);
  const double held = (needs.held + (keeps_view ? 1 : 0)) * 4 * static_cast<double>(area(set.size));
  const int made = needs.made > 0 ? needs.made : set.channels;
  // Every band was read and made; those being computed have maps picked and fitted too, and what
  // these resolve to.
  return {set.size.width, freed_and_kept * (set.channels + made),
          freed_and_kept * (set.channels + (needs.resolved ? set.planes : 0)), set.channels,
          set.held + static_cast<long long>(held)};
}

// Bands and files are let go before the maps are copied into a picture with its levels.
long long bytes_of_material(const SetCost& set, int halvings, const BandPlan& bands, Size picture) {
  constexpr int planes_of_picture = 7;
  const long long maps = (area(set.size) >> (2 * halvings)) * 4 * set.planes;
  const long long copied = maps * 4 / 3 + 4LL * planes_of_picture * area(picture);
  return maps + std::max(bytes_of(cost_of_material(set), bands), process_bytes + copied);
}

BandPlan bands_of_material(const SetCost& set, int halvings, long long budget) {
  BandPlan bands{std::max(64, 1 << halvings), available_threads() + 2};
  if (budget <= 0) return bands;
  const int least = std::max(16, 1 << halvings);
  const auto bytes = [&] { return bytes_of_material(set, halvings, bands, {}); };
  while (bands.at_once > 2 && bytes() > budget) --bands.at_once;
  while (bands.rows > least && bytes() > budget) bands.rows /= 2;
  return bands;
}

int halvings_of(Size set, Size wanted) {
  if (wanted.width <= 0) return 0;
  int halvings = 0;
  while (set.width % 2 == 0 && set.height % 2 == 0 && set.width / 2 >= wanted.width &&
         set.height / 2 >= wanted.height && halvings < 7) {
    set = {set.width / 2, set.height / 2};
    ++halvings;
  }
  return halvings;
}

void require_memory(long long bytes, long long budget, const std::string& what) {
  if (budget <= 0 || bytes <= budget) return;
  throw Error(Fault::Memory, fmt::format("{} needs {}, more than the {} that are allowed", what,
                                         text_of(bytes), text_of(budget)));
}

std::optional<long long> predicted_memory(const Plan& plan, const Task& task) {
  if (!task.set || plan.sets[*task.set].fault) return std::nullopt;
  if (task.needs.maps.any()) {
    const RowCost cost = cost_of_rows(plan, task);
    return bytes_of(cost, plan_bands(cost, plan.max_memory));
  }
  if (!task.needs.material) return std::nullopt;
  const SetCost set = cost_of_set(plan.sets[*task.set], {.resolved = true});
  const Size wanted = task.needs.material_for;
  const Size picture = wanted.width > 0 ? wanted : set.size;
  const int halvings = halvings_of(set.size, wanted);
  const BandPlan bands = bands_of_material(set, halvings, plan.max_memory);
  return bytes_of_material(set, halvings, bands, picture);
}

}  // namespace kiln
