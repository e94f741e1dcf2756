// SPDX-License-Identifier: Apache-2.0
#include "map_colors.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string_view>

#include "color_reading.h"
#include "kiln/core/names.h"

namespace kiln {
namespace {

constexpr const char* space_of_factors = "lin_rec709_scene";

bool is_scaled(const SlotDecoding& decoding) {
  return decoding.scale != SlotDecoding{}.scale || decoding.offset != SlotDecoding{}.offset;
}

void scale_colors(Layers& image, const SlotDecoding& decoding) {
  constexpr std::array<const char*, 3> names = {"R", "G", "B"};
  for (Layer& layer : image.layers) {
    for (size_t c = 0; c < names.size(); ++c) {
      if (layer.name != names[c]) continue;
      for (int y = 0; y < image.size.height; ++y) {
        float* v = layer.plane.row(y);
        for (int x = 0; x < image.size.width; ++x) {
          v[x] = decoding.scale[c] * v[x] + decoding.offset[c];
        }
      }
    }
  }
}

// The config's name of a tag, or empty where the config does not know it.
std::string known_space(const std::string& tag, const ColorConfig& config) {
  const std::vector<std::string> spaces = config.color_spaces();
  const auto found = std::find_if(spaces.begin(), spaces.end(), [&](const std::string& space) {
    return kebab(space) == kebab(tag);
  });
  return found == spaces.end() ? "" : *found;
}

// What is wrong with a space that nobody stated, where the file has a tag.
std::string compared_with_tag(const PlannedMap& map, const FileFacts& facts,
                              const ColorConfig& config, const std::string& from) {
  if (!map.color_space.empty() || !facts.color_space_tag) return "";
  const std::string tagged = known_space(*facts.color_space_tag, config);
  if (tagged.empty() || tagged == config.resolve(from)) return "";
  return fmt::format("{}: tagged {}, read as {}; state its color_space", map.path.string(),
                     *facts.color_space_tag, from);
}

}  // namespace

MapColor decide_color(const PlannedMap& map, const FileFacts& facts, const ColorConfig& config,
                      const ColorChoice& color) {
  if (slot_facts(map.slot).content == Content::Numbers) return {"", "data"};
  const std::string from = space_of(map.color_space, facts.type);
  MapColor decided{from, conversion_text(from, color.working)};
  if (color.on_conversion == ColorChoice::OnConversion::Allow) return decided;
  decided.warning = compared_with_tag(map, facts, config, from);
  if (!decided.warning.empty() && color.on_conversion == ColorChoice::OnConversion::Refuse) {
    throw Error(Fault::Input, decided.warning);
  }
  return decided;
}

void colors_to_working(Layers& image, const std::string& from, const PlannedMap& map,
                       const ColorConfig& config, const std::string& working) {
  if (!is_scaled(map.decoding)) return config.convert(image, from, working);
  config.convert(image, from, space_of_factors);
  scale_colors(image, map.decoding);
  config.convert(image, space_of_factors, working);
}

std::optional<ColorCodes> codes_to_working(const std::string& from, const PlannedMap& map,
                                           const ColorConfig& config, const std::string& working) {
  if (is_scaled(map.decoding) || !config.converts_each_alone(from, working)) return std::nullopt;
  Layers image = make_layers({256, 1}, {"R", "G", "B"});
  for (Layer& layer : image.layers) {
    for (int code = 0; code < 256; ++code) {
      layer.plane.at(code, 0) = static_cast<float>(code) / 255.0f;
    }
  }
  config.convert(image, from, working);
  ColorCodes codes;
  for (size_t c = 0; c < codes.size(); ++c) {
    std::copy_n(image.layers[c].plane.row(0), 256, codes[c].begin());
  }
  return codes;
}

void look_up(const ColorCodes& codes, Layers& image) {
  constexpr std::string_view names = "RGB";
  for (Layer& layer : image.layers) {
    const size_t channel = layer.name.size() == 1 ? names.find(layer.name) : names.npos;
    if (channel == names.npos) continue;
    for (int y = 0; y < image.size.height; ++y) {
      float* row = layer.plane.row(y);
      for (int x = 0; x < image.size.width; ++x) {
        row[x] = codes[channel][static_cast<std::uint8_t>(std::floor(row[x] * 255.0f + 0.5f))];
      }
    }
  }
}

void scale_stored_colors(Layers& image, const std::string& from, const PlannedMap& map,
                         const ColorConfig& config) {
  if (!is_scaled(map.decoding)) return;
  image = as_rgb(std::move(image));
  colors_to_working(image, from, map, config, from);
}

std::string constant_to_working(SlotMap& constant, const PlannedMap& map, const ColorConfig& config,
                                const std::string& working) {
  const bool is_color = slot_facts(map.slot).content == Content::Color;
  if (!is_color || map.color_space.empty()) return "";
  Layers image = make_layers({1, 1}, {"R", "G", "B"});
  for (size_t c = 0; c < 3; ++c) image.layers[c].plane.at(0, 0) = (*constant.value)[c];
  colors_to_working(image, map.color_space, map, config, working);
  for (size_t c = 0; c < 3; ++c) (*constant.value)[c] = image.layers[c].plane.at(0, 0);
  constant.decoding = {};
  return conversion_text(map.color_space, working);
}

}  // namespace kiln
