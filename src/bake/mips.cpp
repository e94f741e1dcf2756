// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "bakes.h"
#include "kiln/bake/mip_sheet.h"
#include "kiln/image/mip_levels.h"
#include "map_files.h"
#include "mip_filter.h"
#include "mip_maps.h"
#include "word_list.h"

namespace kiln {
namespace {

using Settings = MipsBake::Settings;

constexpr const char* every_map = "all";

std::vector<std::string> map_names() {
  std::vector<std::string> names{every_map};
  for (const SlotFacts& facts : slot_list) names.emplace_back(facts.name);
  return names;
}

/// Slots that are asked for by name; none: all that are given.
std::vector<Slot> slots_named(const Settings& settings) {
  std::vector<Slot> slots;
  for (const std::string& name : word_list("map", settings.map, map_names())) {
    if (name == every_map) return {};
    slots.push_back(parse_slot(name));
  }
  return slots;
}

bool is_color(Slot slot) { return slot_facts(slot).content == Content::Color; }
bool is_lobe(Slot slot) { return slot == Slot::Roughness || slot == Slot::Gloss; }

// Each slot with those that it is filtered by.
std::vector<Slot> slots_read(const Settings& settings, const std::vector<Slot>& named) {
  if (named.empty()) return every_slot();
  std::vector<Slot> read = named;
  for (const Slot slot : named) {
    if (is_color(slot)) read.push_back(Slot::Opacity);
    if (!is_lobe(slot)) continue;
    read.push_back(slot == Slot::Gloss ? Slot::Roughness : Slot::Gloss);
    if (settings.method != NormalFilter::None) read.push_back(Slot::Normal);
  }
  return read;
}

/// An image, not a constant.
const GivenMap* image_of(const MapBands& maps, Slot slot) {
  const GivenMap* found = maps.find(slot);
  return found != nullptr && !found->is_constant ? found : nullptr;
}

/// Roughness, or gloss in its place, as an image or a constant.
const GivenMap* width_of(const MapBands& maps) {
  const GivenMap* roughness = maps.find(Slot::Roughness);
  return roughness != nullptr ? roughness : maps.find(Slot::Gloss);
}

MipChoice choose(const Settings& settings, const MapBands& maps, int levels) {
  MipChoice choice;
  choice.normals = {settings.method, settings.strength, settings.threshold};
  if (image_of(maps, Slot::Normal) != nullptr) choice.form = maps.normal;
  const GivenMap* opacity = image_of(maps, Slot::Opacity);
  choice.weighted = opacity != nullptr;
  if (opacity != nullptr && settings.alpha_test > 0) {
    Layers whole = maps.whole(Slot::Opacity);
    Plane plane = std::move(whole.layers.at(0).plane);
    if (plane.size() != maps.size) plane = resample(plane, maps.size);
    choice.opacity_scales = coverage_scales(std::move(plane), levels, settings.alpha_test);
  }
  return choice;
}

bool shares_file(const MapBands& maps, const GivenMap& map) {
  const GivenMap* opacity = image_of(maps, Slot::Opacity);
  return opacity != nullptr && opacity->source == map.source &&
         (map.slot == Slot::BaseColor || map.slot == Slot::Diffuse);
}

/// The files of a sheet, and which of them is of lobes that normals widen.
struct Chosen {
  std::vector<MipMap> maps;
  int judged = -1;
};

class Choosing {
 public:
  Choosing(const Settings& settings, const MapBands& maps, const MipChoice& choice)
      : settings_(settings), maps_(maps), choice_(choice), named_(slots_named(settings)) {}

  Chosen choose() {
    for (const GivenMap& map : maps_.given) {
      if (is_wanted(map.slot) && !is_lobe(map.slot) && !map.is_constant) add(map);
    }
    if (is_wanted(Slot::Roughness) || is_wanted(Slot::Gloss)) add_lobes();
    if (!chosen_.maps.empty()) return std::move(chosen_);
    throw Error(Fault::Input, named_.empty() ? "the set has no map that is an image"
                                             : fmt::format("the set has no {}", settings_.map));
  }

 private:
  bool is_wanted(Slot slot) const {
    return named_.empty() || std::count(named_.begin(), named_.end(), slot) > 0;
  }

  void add(const GivenMap& map) {
    if (is_color(map.slot)) {
      MipChoice choice = choice_;
      choice.opacity_within = shares_file(maps_, map);
      chosen_.maps.push_back(color_mips(map, maps_, choice));
    } else if (map.slot == Slot::Normal) {
      chosen_.maps.push_back(normal_mips(map, choice_));
    } else if (map.slot == Slot::AnisotropyAngle) {
      chosen_.maps.push_back(angle_mips(map));
    } else if (map.slot != Slot::Opacity) {
      chosen_.maps.push_back(number_mips(map));
    } else if (!named_.empty() || !within_colors()) {
      chosen_.maps.push_back(opacity_mips(map, choice_));
    }
  }

  bool within_colors() const {
    return std::any_of(maps_.given.begin(), maps_.given.end(),
                       [&](const GivenMap& map) { return shares_file(maps_, map); });
  }

  // A constant is widened too, where there are normals to do it.
  void add_lobes() {
    const GivenMap* width = width_of(maps_);
    const bool widened = choice_.form && settings_.method != NormalFilter::None;
    if (width == nullptr || (width->is_constant && !widened)) {
      if (named_.empty()) return;
      throw Error(Fault::Input,
                  "the set has no map of roughness or gloss, and no constant that normals could "
                  "widen; state one: maps: { roughness: 0.5 }");
    }
    const bool gloss = named_.empty() ? width->slot == Slot::Gloss : !is_wanted(Slot::Roughness);
    if (widened) chosen_.judged = static_cast<int>(chosen_.maps.size());
    if (gloss) chosen_.judged = -1;
    chosen_.maps.push_back(
        roughness_mips(gloss ? "gloss" : "roughness", gloss, width->stored_type, choice_));
    if (settings_.anisotropy) chosen_.maps.push_back(anisotropy_mips(width->stored_type, choice_));
  }

  const Settings& settings_;
  const MapBands& maps_;
  const MipChoice& choice_;
  std::vector<Slot> named_;
  Chosen chosen_;
};

// NaN and infinite values would spread over all levels.
void make_finite(Slot slot, Layers& image) {
  for (size_t c = 0; c < image.layers.size(); ++c) {
    const float replacement = slot_facts(slot).missing[std::min<size_t>(c, 2)];
    Plane& plane = image.layers[c].plane;
    for (int y = 0; y < plane.height(); ++y) {
      float* row = plane.row(y);
      for (int x = 0; x < plane.width(); ++x) {
        row[x] = std::isfinite(row[x]) ? row[x] : replacement;
      }
    }
  }
}

Plane roughness_of(const MapBands& maps, const SlotMaps& stored, Size size) {
  const GivenMap* width = width_of(maps);
  if (width == nullptr) return {};
  const SlotMap& map = stored.at(width->slot);
  const bool gloss = width->slot == Slot::Gloss;
  if (map.value) {
    return Plane(size, std::clamp(gloss ? 1.0f - (*map.value)[0] : (*map.value)[0], 0.0f, 1.0f));
  }
  Plane plane = map.image.layers[0].plane;
  for (int y = 0; y < plane.height(); ++y) {
    float* row = plane.row(y);
    for (int x = 0; x < plane.width(); ++x) {
      row[x] = std::clamp(gloss ? 1.0f - row[x] : row[x], 0.0f, 1.0f);
    }
  }
  return plane;
}

MipBand band_of(const MapBands& maps, const MapRows& rows) {
  MipBand band;
  band.first = rows.rows.first;
  band.rows = rows.rows.count;
  band.stored = maps.stored(rows);
  band.linear = maps.linear(rows);
  for (SlotMaps* read : {&band.stored, &band.linear}) {
    for (auto& [slot, map] : *read) make_finite(slot, map.image);
  }
  band.roughness = roughness_of(maps, band.stored, {maps.size.width, rows.rows.count});
  if (maps.normal && image_of(maps, Slot::Normal) != nullptr) {
    band.normal = decode_normals(band.stored.at(Slot::Normal).image, maps.normal->decoding).normal;
  }
  return band;
}

std::vector<std::string> notes_of(const Settings& settings, const MapBands& maps,
                                  const MipChoice& choice) {
  std::vector<std::string> notes;
  for (const GivenMap& map : maps.given) {
    if (map.is_constant || map.size == maps.size) continue;
    notes.push_back(fmt::format("{} is {} x {} and is resampled to {} x {}", map.source,
                                map.size.width, map.size.height, maps.size.width,
                                maps.size.height));
  }
  if (settings.alpha_test > 0 && choice.opacity_scales.empty()) {
    notes.emplace_back("alpha_test: the set has no opacity map");
  }
  if (settings.alpha_test == 0 && maps.alpha_cutoff && choice.weighted) {
    notes.push_back(fmt::format("the set is a cutout: alpha_test {} would keep its coverage",
                                *maps.alpha_cutoff));
  }
  return notes;
}

}  // namespace

Params<Settings> MipsBake::params() {
  std::vector<std::string> methods(normal_filter_names.begin(), normal_filter_names.end());
  return {
      text_param("map", &Settings::map,
                 "slots to make levels of, separated by commas; all: every map of the set"),
      word_param("method", &Settings::method, methods, "how normals widen roughness"),
      number_param("strength", &Settings::strength, {0, 16}, "",
                   "factor of what normals add to alpha^2"),
      number_param("threshold", &Settings::threshold, {0, 1}, "",
                   "the most that normals add to alpha^2"),
      flag_param("anisotropy", &Settings::anisotropy,
                 "also a map of alpha_x, alpha_y and their angle (lean)"),
      integer_param("levels", &Settings::levels, {0, 32}, "how many, the first included; 0: all"),
      number_param(
          "alpha_test", &Settings::alpha_test, {0, 1}, "",
          "opacity above which cutouts are solid; levels keep its share of texels; 0: off"),
      choice_param("format", &Settings::format, {"exr", "tif", "tx", "dds", "ktx2", "files"},
                   "container of all levels, or a file per level; default: as the output's name "
                   "says, else exr")};
}

Needs MipsBake::needs(const Settings& settings) {
  const std::vector<Slot> named = slots_named(settings);
  if (settings.anisotropy && settings.method != NormalFilter::Lean) {
    throw Error(Fault::Usage,
                fmt::format("anisotropy: method {} tells none, expected lean",
                            normal_filter_names[static_cast<size_t>(settings.method)]));
  }
  Needs needs;
  needs.maps.stored = slots_read(settings, named);
  if (settings.alpha_test > 0) needs.maps.held = 1.25;  // opacity, and the level below
  return needs;
}

Baked MipsBake::bake(const Settings& settings, const Ingredients& ingredients) {
  const MapBands& maps = *ingredients.maps;
  const std::vector<Size> sizes = level_sizes(maps.size, settings.levels);
  const MipChoice choice = choose(settings, maps, static_cast<int>(sizes.size()));
  Chosen chosen = Choosing(settings, maps, choice).choose();
  MipSheet sheet;
  for (const MipMap& map : chosen.maps) sheet.files.push_back(map.file);
  sheet.size = maps.size;
  sheet.levels = static_cast<int>(sizes.size());
  sheet.file_per_level = settings.format == "files";
  if (!settings.format.empty() && !sheet.file_per_level) sheet.extension = "." + settings.format;
  const auto filter = std::make_shared<MipFilter>(std::move(chosen.maps), sizes, chosen.judged);
  sheet.read = [&maps](const MapRows& rows) -> std::shared_ptr<void> {
    return std::make_shared<MipBand>(band_of(maps, rows));
  };
  sheet.filter = [filter](void* band) { return filter->add(*static_cast<MipBand*>(band)); };
  sheet.figures = [filter] { return filter->figures(); };
  Baked baked;
  baked.notes = notes_of(settings, maps, choice);
  baked.mips = std::move(sheet);
  return baked;
}

}  // namespace kiln
