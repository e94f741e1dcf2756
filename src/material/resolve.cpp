// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "given_maps.h"
#include "kiln/core/error.h"
#include "kiln/image/resample.h"
#include "kiln/material/resolver.h"
#include "kiln/material/slot_values.h"
#include "workflow_reads.h"

namespace kiln {
namespace {

using Texts = std::vector<std::string>;

template <class... Args>
void say(Texts& texts, fmt::format_string<Args...> text, Args&&... args) {
  texts.push_back(fmt::format(text, std::forward<Args>(args)...));
}

void note_missing(const SlotMaps& maps, Workflow workflow, Texts& notes) {
  for (const std::vector<Slot>& alternatives : alternatives_of(workflow)) {
    const Slot wanted = alternatives.front();
    const Slot slot = choose(maps, alternatives);
    if (slot != wanted) {
      say(notes, "{}: no map, {} is read instead", slot_name(wanted), slot_name(slot));
    } else if (!maps.count(slot)) {
      const std::string constant = slot == Slot::Normal
                                       ? std::string("flat")
                                       : fmt::format("constant {}", slot_facts(slot).missing[0]);
      say(notes, "{}: no map, {}", slot_name(slot), constant);
    }
  }
}

void note_unread(const SlotMaps& maps, const std::vector<Slot>& read, Workflow workflow,
                 Texts& notes) {
  for (const auto& [slot, map] : maps) {
    if (std::count(read.begin(), read.end(), slot)) continue;
    if (slot == Slot::Emissive || slot == Slot::Opacity) {
      say(notes, "{}: not rendered, ignored", slot_name(slot));
    } else if (slot == Slot::Height) {
      say(notes, "height: not displaced; at most it tells OpenGL from DirectX normals");
    } else {
      say(notes, "{}: not read by {}", slot_name(slot), workflow_name(workflow));
    }
  }
}

std::string text_of(Size size) { return fmt::format("{}x{}", size.width, size.height); }

// "1234 (0.12 %)"
std::string share_text(long long count, long long of) {
  return fmt::format("{} ({:.2g} %)", count,
                     100.0 * static_cast<double>(count) / static_cast<double>(of));
}

void note_normals(const Repairs& repairs, bool is_resampled, Texts& notes) {
  if (repairs.not_unit) {
    say(notes, "normal: {} are longer or shorter than 1 by more than {:.3f}{}, made unit",
        share_text(repairs.not_unit, repairs.normals), unit_tolerance,
        is_resampled ? " once resampled" : "");
  }
  if (repairs.degenerate) {
    say(notes, "normal: {} without direction, made flat",
        share_text(repairs.degenerate, repairs.normals));
  }
  if (repairs.below_surface) {
    say(notes, "normal: {} below the surface, raised above it",
        share_text(repairs.below_surface, repairs.normals));
  }
}

void warn_of_repairs(Slot slot, Bounds bounds, const Repairs::OfSlot& repairs, Texts& warnings) {
  if (repairs.unreadable > 0) {
    say(warnings, "{}: {} values are NaN or Inf, replaced by {}", slot_name(slot),
        repairs.unreadable, slot_facts(slot).missing[0]);
  }
  if (repairs.clamped > 0) {
    say(warnings, "{}: {} values clamped to [{}, {}]", slot_name(slot), repairs.clamped, bounds.low,
        bounds.high);
  }
}

void append(const Texts& more, Texts& texts) {
  texts.insert(texts.end(), more.begin(), more.end());
}

void require_texels(const SlotMaps& maps, const std::vector<Slot>& read) {
  for (const Slot slot : read) {
    const SlotMap* map = given_image(maps, slot);
    if (map && (map->image.layers.empty() || area(map->image.size) == 0)) {
      throw Error(Fault::Input,
                  fmt::format("{} {}: the map has no texels", slot_name(slot), map->source));
    }
  }
}

// The same without texels.
SlotMaps heads_of(const SlotMaps& maps) {
  SlotMaps heads;
  for (const auto& [slot, map] : maps) {
    SlotMap& head = heads[slot];
    head.value = map.value;
    head.convention = map.convention;
    head.encoding = map.encoding;
    head.decoding = map.decoding;
    head.source = map.source;
    head.image.size = map.image.size;
    for (const Layer& layer : map.image.layers) head.image.layers.push_back({layer.name, {}});
  }
  return heads;
}

// A float file may store components as they are; how it was stored is not known here.
std::optional<NormalForm> survey(const SlotMaps& maps, const WorkflowSettings& settings) {
  const SlotMap* normal = given_image(maps, Slot::Normal);
  if (!normal) return std::nullopt;
  const SlotMap* height = given_image(maps, Slot::Height);
  const bool has_height = height && !height->image.layers.empty();
  NormalSurvey survey(*normal, settings, has_height, true);
  if (has_height) {
    const Plane fitted = resample(height->image.layers[0].plane, normal->image.size);
    survey.add(normal->image, &fitted);
  } else {
    survey.add(normal->image, nullptr);
  }
  return survey.form();
}

}  // namespace

std::vector<std::string> Resolver::notes(const Repairs& repairs) const {
  Texts notes;
  note_missing(heads_, settings_.workflow, notes);
  note_unread(heads_, read_, settings_.workflow, notes);
  if (normal_) append(normal_->notes, notes);
  const SlotMap* normal = given_image(heads_, Slot::Normal);
  note_normals(repairs, normal && normal->image.size != size_, notes);
  for (const Slot slot : read_) {
    const SlotMap* map = given_image(heads_, slot);
    if (!map || map->image.size == size_) continue;
    say(notes, "{} {} resampled to {}", slot_name(slot), text_of(map->image.size), text_of(size_));
  }
  return notes;
}

std::vector<std::string> Resolver::warnings(const Repairs& repairs) const {
  Texts warnings;
  if (normal_) append(normal_->warnings, warnings);
  if (repairs.unreadable_normals) {
    say(warnings, "normal: {} are NaN or Inf, made flat", repairs.unreadable_normals);
  }
  for (const Slot slot : read_) {
    warn_of_repairs(slot, bounds_of(heads_, slot), repairs.slots[static_cast<size_t>(slot)],
                    warnings);
  }
  return warnings;
}

Resolved resolve(SlotMaps maps, const WorkflowSettings& settings) {
  std::vector<Slot> given;
  for (const auto& [slot, map] : maps) given.push_back(slot);
  require_texels(maps, slots_read(settings.workflow, given));
  const Resolver resolver(heads_of(maps), settings, survey(maps, settings));
  SlotMaps read;
  for (const Slot slot : resolver.read()) {
    SlotMap& map = read[slot] = std::move(maps.at(slot));
    if (map.value) continue;
    decode_slot(slot, map);
    map.image = resample(map.image, resolver.size());
  }
  Repairs repairs;
  Resolved resolved;
  resolved.svbrdf = resolver.rows(std::move(read), repairs);
  resolved.notes = resolver.notes(repairs);
  resolved.warnings = resolver.warnings(repairs);
  return resolved;
}

}  // namespace kiln
