// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "kiln/image/layers.h"

namespace kiln {

/// What a map of a texture set means.
enum class Slot {
  BaseColor,
  Diffuse,
  Roughness,
  Gloss,
  Metallic,
  SpecularColor,
  SpecularLevel,
  Normal,
  AmbientOcclusion,
  Height,
  Opacity,
  Emissive
};

/// Colour goes through colour management; numbers never do.
enum class Content { Color, Numbers };

struct SlotFacts {
  Slot slot;
  std::string_view name;     ///< snake_case, the key in files
  std::string_view aliases;  ///< other accepted keys, separated by spaces
  Content content;
  int channels;                  ///< 1 or 3
  std::array<float, 3> missing;  ///< constant where no map is given, as stored [0..1]
  std::string_view meaning;
};

/// Every slot there is, in the order of the enumeration. Parsing, listing, naming schemes and the
/// constants of missing maps follow from it.
inline constexpr std::array<SlotFacts, 12> slot_list = {{
    {Slot::BaseColor,
     "base_color",
     "albedo",
     Content::Color,
     3,
     {0.8f, 0.8f, 0.8f},
     "diffuse reflectance of a dielectric, specular reflectance of a metal"},
    {Slot::Diffuse,
     "diffuse",
     "diffuse_color",
     Content::Color,
     3,
     {0.8f, 0.8f, 0.8f},
     "diffuse reflectance, black where the surface is metal"},
    {Slot::Roughness,
     "roughness",
     "",
     Content::Numbers,
     1,
     {1, 1, 1},
     "perceptual roughness, 0 mirror"},
    {Slot::Gloss,
     "gloss",
     "glossiness smoothness",
     Content::Numbers,
     1,
     {0, 0, 0},
     "1 - roughness, 1 mirror"},
    {Slot::Metallic,
     "metallic",
     "metalness metal",
     Content::Numbers,
     1,
     {0, 0, 0},
     "0 dielectric, 1 metal"},
    {Slot::SpecularColor,
     "specular_color",
     "specular_colour f0",
     Content::Color,
     3,
     {0.04f, 0.04f, 0.04f},
     "reflectance at normal incidence"},
    {Slot::SpecularLevel,
     "specular_level",
     "specular",
     Content::Numbers,
     1,
     {0.5f, 0.5f, 0.5f},
     "reflectance of the dielectric part; 0.5 is 4 % in the encoding 'level'"},
    {Slot::Normal,
     "normal",
     "normals",
     Content::Numbers,
     3,
     {0.5f, 0.5f, 1.0f},
     "surface normal in the tangent frame, stored as (n + 1) / 2"},
    {Slot::AmbientOcclusion,
     "ambient_occlusion",
     "ao occlusion",
     Content::Numbers,
     1,
     {1, 1, 1},
     "1 unoccluded; dims diffuse environment light"},
    {Slot::Height,
     "height",
     "displacement",
     Content::Numbers,
     1,
     {0.5f, 0.5f, 0.5f},
     "height; read only to tell OpenGL from DirectX normals"},
    {Slot::Opacity, "opacity", "alpha", Content::Numbers, 1, {1, 1, 1}, "1 opaque; not rendered"},
    {Slot::Emissive,
     "emissive",
     "emission",
     Content::Color,
     3,
     {0, 0, 0},
     "emitted light; not rendered"},
}};

constexpr const SlotFacts& slot_facts(Slot slot) { return slot_list[static_cast<size_t>(slot)]; }
constexpr std::string_view slot_name(Slot slot) { return slot_facts(slot).name; }

/// @error Fault::Usage, naming the nearest known slot
Slot parse_slot(std::string_view name);

/// The planes of a file that one slot reads: "rgb", "r", "g", "b" or "a" as a naming scheme or a
/// user says. A grey image answers to r, g and b alike.
/// @error Fault::Input when the file has no such channel
Layers pick_channels(const Layers& file, std::string_view channels);

/// The same for a slot: a normal map may do without blue, and a grey one stays one plane, so that
/// it is refused later instead of being read as a slope along the diagonal.
Layers pick_slot(const Layers& file, Slot slot, std::string_view channels);

/// Those of `channels` that it would take: "rg" of a normal map without blue.
std::string slot_channels(const std::vector<std::string>& channel_names, Slot slot,
                          std::string_view channels);

/// Whether `pick_channels` would find them.
bool has_channels(const std::vector<std::string>& channel_names, std::string_view channels);

/// The names, one for each letter, of the channels that it would take.
/// @error as pick_channels
std::vector<std::string> picked_names(const std::vector<std::string>& channel_names,
                                      std::string_view channels);

}  // namespace kiln
