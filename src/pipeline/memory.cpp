// SPDX-License-Identifier: Apache-2.0
#include "memory.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "kiln/io/image_file.h"
#include "kiln/parallel/threads.h"
#include "outputs.h"
#include "set_reader.h"

namespace kiln {
namespace {

constexpr long long mebibyte = 1LL << 20;
constexpr long long process_bytes = 170 * mebibyte;  // with the libraries that decode images
constexpr int resolved_planes = 11;
constexpr int picture_planes = 8;  // colours and alpha, standard errors, samples
constexpr long long most_of_plane = mebibyte / 4;
constexpr int rows_of_block = 64;  // that decoders give at once

// "1.5 GiB", "300 MiB"
std::string text_of(long long bytes) {
  const double mib = static_cast<double>(bytes) / static_cast<double>(mebibyte);
  return mib >= 1024 ? fmt::format("{:.2f} GiB", mib / 1024) : fmt::format("{:.0f} MiB", mib);
}

RowCost cost_of_material(Size set) {
  return {set.width, resolved_planes, 2 * resolved_planes, resolved_planes};
}

/// Of the files of a set that a task reads.
struct SetShape {
  Size size{1, 1};
  int channels = 0;
};

SetShape shape_of(const PlannedSet& set, const MapNeeds& needs) {
  SetShape shape;
  std::set<std::filesystem::path> seen;
  for (const PlannedMap& map : maps_needed(set, needs)) {
    if (map.path.empty() || !seen.insert(map.path).second) continue;
    const FileFacts facts =
        map.embedded.bytes ? inspect_image(map.embedded) : inspect_image(map.path);
    if (area(facts.size) > area(shape.size)) shape.size = facts.size;
    shape.channels += static_cast<int>(facts.channels.size());
  }
  return shape;
}

}  // namespace

long long bytes_of(const RowCost& cost, const BandPlan& bands) {
  const long long decoding = 5LL * cost.width * cost.channels * rows_of_block;
  const long long planes = 1LL * cost.planes * bands.at_once +
                           1LL * cost.working * std::min(bands.at_once, available_threads());
  return process_bytes + decoding + 4LL * cost.width * bands.rows * planes + cost.held;
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

long long bytes_of_material(Size set, int halvings, const BandPlan& bands) {
  // The maps themselves, and their copy in a picture with its levels.
  const long long maps = (area(set) >> (2 * halvings)) * 4 * resolved_planes;
  return bytes_of(cost_of_material(set), bands) + maps + maps * 4 / 3;
}

BandPlan bands_of_material(Size set, int halvings, long long budget) {
  BandPlan bands{128, 8};
  if (budget <= 0) return bands;
  const int least = std::max(16, 1 << halvings);
  const auto bytes = [&] { return bytes_of_material(set, halvings, bands); };
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
  const PlannedSet& set = plan.sets[*task.set];
  if (task.needs.maps.any()) {
    const SetShape shape = shape_of(set, task.needs.maps);
    const RowCost cost = cost_of_rows(task, shape.size, shape.channels);
    return bytes_of(cost, plan_bands(cost, plan.max_memory));
  }
  if (!task.needs.material) return std::nullopt;
  const SetShape shape = shape_of(set, {.resolved = true});
  const Size wanted = task.needs.material_for;
  const Size picture = wanted.width > 0 ? wanted : shape.size;
  const int halvings = halvings_of(shape.size, wanted);
  const BandPlan bands = bands_of_material(shape.size, halvings, plan.max_memory);
  return bytes_of_material(shape.size, halvings, bands) + 4LL * 7 * area(picture);
}

RowCost cost_of_rows(const Task& task, Size set, int channels_read) {
  if (task.product == Product::Picture) {
    const bool keeps = task.needs.late_view && is_for_viewing(task.out);
    return {set.width, channels_read + resolved_planes + picture_planes,
            channels_read + resolved_planes, channels_read, keeps ? 4 * area(set) : 0};
  }
  // What is read, the same picked and fitted, what it is resolved to, and what is made of it.
  const bool resolved = task.needs.maps.resolved;
  const int planes = resolved ? 2 * channels_read + 3 * resolved_planes : 3 * channels_read;
  return {set.width, planes, 0, channels_read};
}

}  // namespace kiln
