// SPDX-License-Identifier: Apache-2.0
#include "map_keys.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "block_reading.h"
#include "kiln/core/error.h"
#include "kiln/core/names.h"
#include "kiln/core/param.h"

namespace kiln {
namespace {

std::array<float, 3> one_or_three(const std::string& key, const std::string& text) {
  ParamFacts facts;
  facts.name = key;
  std::vector<float> numbers;
  for (size_t begin = 0; begin <= text.size();) {
    const size_t comma = std::min(text.find(',', begin), text.size());
    size_t first = begin;
    while (first < comma && text[first] == ' ') ++first;
    numbers.push_back(static_cast<float>(parse_number(facts, text.substr(first, comma - first))));
    begin = comma + 1;
  }
  if (numbers.size() == 1) return {numbers[0], numbers[0], numbers[0]};
  if (numbers.size() == 3) return {numbers[0], numbers[1], numbers[2]};
  throw Error(Fault::Usage, fmt::format("{}: found '{}', expected one number or three", key, text));
}

template <class Names>
size_t encoding_index(Slot slot, const std::string& word, const Names& names) {
  const auto found = std::find(names.begin(), names.end(), kebab(word));
  if (found != names.end()) return static_cast<size_t>(found - names.begin());
  throw Error(Fault::Usage, fmt::format("encoding: found '{}', expected of {}: {}", word,
                                        slot_name(slot), fmt::join(names, ", ")));
}

void read_encoding(const std::string& word, MapChoice& map) {
  const auto index = [&](const auto& names) { return encoding_index(map.slot, word, names); };
  switch (map.slot) {
    case Slot::SpecularLevel:
      map.encoding = static_cast<SpecularEncoding>(index(specular_encoding_names));
      return;
    case Slot::Roughness:
      map.decoding.roughness = static_cast<RoughnessEncoding>(index(roughness_encoding_names));
      return;
    case Slot::Anisotropy:
      map.decoding.anisotropy = static_cast<AnisotropyEncoding>(index(anisotropy_encoding_names));
      return;
    case Slot::AnisotropyAngle:
      map.decoding.angle = static_cast<AngleEncoding>(index(angle_encoding_names));
      return;
    default:
      throw Error(Fault::Usage, fmt::format("encoding: {} has none", slot_name(map.slot)));
  }
}

void check_channel(const MapChoice& map) {
  const bool several = map.channel.size() > 1;
  const bool direction = map.decoding.angle == AngleEncoding::Direction;
  const bool fits = !several || (map.channel == "rgb" && slot_facts(map.slot).channels == 3) ||
                    (map.channel == "rg" && (map.slot == Slot::Normal || direction));
  if (fits) return;
  throw Error(Fault::Usage, fmt::format("channel: found '{}', but {} takes one of r, g, b, a",
                                        map.channel, slot_name(map.slot)));
}

}  // namespace

void read_map_keys(const Node& node, MapChoice& map) {
  map.channel = kebab(text_at(node, "channel"));
  map.color_space = text_at(node, "color_space");
  with(node, "convention", [&](const Node& word) {
    const auto& names = normal_convention_names;
    const auto found = std::find(names.begin(), names.end(), kebab(word.text));
    map.convention = static_cast<NormalConvention>(found - names.begin());
  });
  with(node, "value",
       [&](const Node& value) { map.value = one_or_three("value", one_text(value)); });
  with(node, "encoding", [&](const Node& word) { read_encoding(word.text, map); });
  with(node, "scale",
       [&](const Node& value) { map.decoding.scale = one_or_three("scale", one_text(value)); });
  with(node, "offset",
       [&](const Node& value) { map.decoding.offset = one_or_three("offset", one_text(value)); });
  check_channel(map);
}

}  // namespace kiln
