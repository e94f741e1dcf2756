// SPDX-License-Identifier: Apache-2.0
#include "inputs.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "kiln/parallel/stages.h"
#include "memory.h"
#include "set_reader.h"

namespace kiln {
namespace {

std::vector<Plane*> planes_of(Svbrdf& svbrdf) {
  std::vector<Plane*> planes;
  for (auto* three : {&svbrdf.diffuse_color, &svbrdf.f0, &svbrdf.normal}) {
    for (Plane& plane : *three) planes.push_back(&plane);
  }
  planes.push_back(&svbrdf.roughness);
  planes.push_back(&svbrdf.ambient_occlusion);
  for (Plane* plane : {&svbrdf.anisotropy, &svbrdf.anisotropy_angle}) {
    if (!plane->empty()) planes.push_back(plane);
  }
  return planes;
}

void place(Svbrdf& band, int first, Svbrdf& whole) {
  const std::vector<Plane*> from = planes_of(band), to = planes_of(whole);
  for (size_t i = 0; i < to.size(); ++i) {
    for (int y = 0; y < band.size.height; ++y) {
      const auto row = from[i]->texels_of_row(y);
      std::copy(row.begin(), row.end(), to[i]->row(first + y));
    }
  }
}

}  // namespace

LoadedSet load_set(const PlannedSet& set, const ColorChoice& color, const ColorConfig& config,
                   Size wanted, long long max_memory) {
  SetReader reader(set, color, config, {.resolved = true});
  const Size size = reader.bands().size;
  const SetCost cost = cost_of_set(set, {.resolved = true});
  const int halvings = halvings_of(size, wanted);
  const BandPlan bands = bands_of_material(cost, halvings, max_memory);
  require_memory(bytes_of_material(cost, halvings, bands, wanted), max_memory,
                 fmt::format("{}: a set of {} x {} texels", set.name, size.width, size.height));
  LoadedSet loaded;
  Svbrdf& whole = loaded.svbrdf;
  whole.name = set.name;
  whole.size = {size.width >> halvings, size.height >> halvings};
  whole.wrap = reader.bands().wrap;
  if (reader.bands().find(Slot::Anisotropy)) whole.anisotropy = Plane(whole.size);
  if (reader.bands().find(Slot::AnisotropyAngle)) whole.anisotropy_angle = Plane(whole.size);
  for (Plane* plane : planes_of(whole)) *plane = Plane(whole.size);
  run_stages<MapRows>(
      (size.height + bands.rows - 1) / bands.rows, bands.at_once,
      [&](int i) { return reader.next(std::min(bands.rows, size.height - i * bands.rows)); },
      [&](int, MapRows& rows) {
        Svbrdf band = reader.bands().svbrdf(rows);
        for (int i = 0; i < halvings; ++i) band = halve(band);
        place(band, rows.rows.first >> halvings, whole);
      },
      [](int, MapRows&) {});
  loaded.record = reader.record();
  return loaded;
}

}  // namespace kiln
