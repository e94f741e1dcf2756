// SPDX-License-Identifier: Apache-2.0
#include "kiln/material/slots.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <optional>

#include "kiln/core/error.h"
#include "kiln/core/names.h"

namespace kiln {
namespace {

bool has_word(std::string_view words, std::string_view word) {
  while (!words.empty()) {
    const size_t end = std::min(words.find(' '), words.size());
    if (words.substr(0, end) == word) return true;
    words.remove_prefix(std::min(end + 1, words.size()));
  }
  return false;
}

// "diffuse.R" and "R" both end in the channel r.
char last_letter(std::string_view channel) {
  const size_t dot = channel.rfind('.');
  if (dot != std::string_view::npos) channel.remove_prefix(dot + 1);
  if (channel.size() != 1) return '\0';
  return static_cast<char>(std::tolower(static_cast<unsigned char>(channel[0])));
}

bool is_grey(const std::vector<std::string>& names) {
  return names.size() == 1 || (names.size() == 2 && last_letter(names[1]) == 'a');
}

// By name; else a grey image answers to r, g and b, and colour channels may be called x, y, z.
std::optional<size_t> find_channel(const std::vector<std::string>& names, char wanted) {
  for (size_t i = 0; i < names.size(); ++i) {
    if (last_letter(names[i]) == wanted) return i;
  }
  if (wanted == 'a') return std::nullopt;
  if (is_grey(names)) return 0;
  const size_t place = std::string_view("rgb").find(wanted);
  const bool no_rgb = std::none_of(names.begin(), names.end(), [](const std::string& name) {
    return std::string_view("rgb").find(last_letter(name)) != std::string_view::npos &&
           last_letter(name) != '\0';
  });
  if (no_rgb && place != std::string_view::npos && place < names.size()) return place;
  return std::nullopt;
}

std::vector<std::string> channel_names(const Layers& image) {
  std::vector<std::string> names;
  for (const Layer& layer : image.layers) names.push_back(layer.name);
  return names;
}

}  // namespace

Slot parse_slot(std::string_view name) {
  const std::string wanted = snake(name);
  std::vector<std::string> known;
  for (const SlotFacts& facts : slot_list) {
    if (facts.name == wanted || has_word(facts.aliases, wanted)) return facts.slot;
    known.emplace_back(facts.name);
  }
  throw Error(Fault::Usage, unknown_name("map", name, known));
}

bool has_channels(const std::vector<std::string>& names, std::string_view channels) {
  return std::all_of(channels.begin(), channels.end(),
                     [&](char wanted) { return find_channel(names, wanted).has_value(); });
}

std::vector<std::string> picked_names(const std::vector<std::string>& names,
                                      std::string_view channels) {
  std::vector<std::string> picked;
  for (const char wanted : channels) {
    const auto found = find_channel(names, wanted);
    if (!found) {
      throw Error(Fault::Input,
                  fmt::format("no channel '{}', the image has {}", wanted, fmt::join(names, ", ")));
    }
    picked.push_back(names[*found]);
  }
  return picked;
}

Layers pick_channels(const Layers& file, std::string_view channels) {
  const std::vector<std::string> names = picked_names(channel_names(file), channels);
  Layers picked{file.size, {}};
  for (size_t i = 0; i < names.size(); ++i) {
    const char upper = static_cast<char>(std::toupper(static_cast<unsigned char>(channels[i])));
    picked.layers.push_back({std::string(1, upper), *file.find(names[i])});
  }
  return picked;
}

std::string slot_channels(const std::vector<std::string>& names, Slot slot,
                          std::string_view channels) {
  if (slot != Slot::Normal || channels != "rgb") return std::string(channels);
  if (is_grey(names)) return "r";
  return !has_channels(names, "b") && has_channels(names, "rg") ? "rg" : "rgb";
}

Layers pick_slot(const Layers& file, Slot slot, std::string_view channels) {
  return pick_channels(file, slot_channels(channel_names(file), slot, channels));
}

}  // namespace kiln
