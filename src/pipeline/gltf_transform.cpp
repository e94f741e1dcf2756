// SPDX-License-Identifier: Apache-2.0
#include "gltf_transform.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace kiln {
namespace {

// "offset 0.5 0, scale 2 2", or nothing.
std::string transform_text(const TexturePlacing& placing) {
  const TexturePlacing plain;
  std::string text;
  const auto add = [&](const std::string& part) { text += (text.empty() ? "" : ", ") + part; };
  if (placing.offset != plain.offset) {
    add(fmt::format("offset {} {}", placing.offset[0], placing.offset[1]));
  }
  if (placing.rotation != 0) add(fmt::format("rotation {:.6g}", placing.rotation));
  if (placing.scale != plain.scale) {
    add(fmt::format("scale {} {}", placing.scale[0], placing.scale[1]));
  }
  return text;
}

std::string described(const TexturePlacing& placing, bool with_coordinates) {
  const std::string transform = transform_text(placing);
  const std::string place = transform.empty() ? "as it is" : transform;
  return with_coordinates ? fmt::format("{} on coordinates {}", place, placing.coordinates) : place;
}

}  // namespace

TexturePlacing placing_of(const JsonAt& use, Wrap wrap) {
  TexturePlacing placing;
  placing.coordinates = use.index("texCoord").value_or(0);
  const auto extensions = use.find("extensions");
  const auto transform =
      extensions ? extensions->find("KHR_texture_transform") : std::optional<JsonAt>();
  if (!transform) return placing;
  placing.coordinates = transform->index("texCoord").value_or(placing.coordinates);
  placing.offset = transform->numbers<2>("offset", placing.offset);
  placing.scale = transform->numbers<2>("scale", placing.scale);
  placing.rotation = transform->number("rotation", 0);
  if (wrap == Wrap::Repeat) {
    for (float& v : placing.offset) v -= std::floor(v);
  }
  return placing;
}

void TexturePlacings::add(const std::string& use, const TexturePlacing& placing) {
  const auto found = std::find_if(groups_.begin(), groups_.end(),
                                  [&](const Group& group) { return group.placing == placing; });
  if (found == groups_.end()) {
    groups_.push_back({placing, use});
  } else {
    found->uses += ", " + use;
  }
}

std::string TexturePlacings::difference() const {
  if (groups_.size() < 2) return "";
  const bool other_coordinates =
      std::any_of(groups_.begin(), groups_.end(), [&](const Group& group) {
        return group.placing.coordinates != groups_.front().placing.coordinates;
      });
  std::string text;
  for (const Group& group : groups_) {
    text += fmt::format("{}{} {}", text.empty() ? "" : "; ", group.uses,
                        described(group.placing, other_coordinates));
  }
  return text;
}

std::string TexturePlacings::common() const {
  return groups_.size() == 1 ? transform_text(groups_.front().placing) : "";
}

}  // namespace kiln
