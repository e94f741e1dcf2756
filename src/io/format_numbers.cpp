// SPDX-License-Identifier: Apache-2.0
#include "format_numbers.h"

#include <algorithm>
#include <span>

namespace kiln::io {
namespace {

struct Numbered {
  uint32_t number;
  TexelFormat texel;
};

using enum Coding;

// Microsoft, "DXGI_FORMAT enumeration". The first of a type and number of channels is written.
constexpr Numbered dxgi[] = {
    {2, {Float, "RGBA"}},        {6, {Float, "RGB"}},    {10, {Half, "RGBA"}},
    {11, {Unorm16, "RGBA"}},     {16, {Float, "RG"}},    {24, {Rgb10a2, "RGBA"}},
    {26, {R11g11b10f, "RGB"}},   {28, {Unorm8, "RGBA"}}, {29, {Unorm8, "RGBA", true}},
    {34, {Half, "RG"}},          {35, {Unorm16, "RG"}},  {41, {Float, "Y"}},
    {49, {Unorm8, "RG"}},        {54, {Half, "Y"}},      {56, {Unorm16, "Y"}},
    {61, {Unorm8, "Y"}},         {65, {Unorm8, "A"}},    {67, {Rgb9e5, "RGB"}},
    {87, {Unorm8, "BGRA"}},      {88, {Unorm8, "BGRX"}}, {91, {Unorm8, "BGRA", true}},
    {93, {Unorm8, "BGRX", true}}};

// Khronos, "Vulkan Specification", VkFormat.
constexpr Numbered vulkan[] = {{9, {Unorm8, "Y"}},         {15, {Unorm8, "Y", true}},
                               {16, {Unorm8, "RG"}},       {22, {Unorm8, "RG", true}},
                               {23, {Unorm8, "RGB"}},      {29, {Unorm8, "RGB", true}},
                               {30, {Unorm8, "BGR"}},      {36, {Unorm8, "BGR", true}},
                               {37, {Unorm8, "RGBA"}},     {43, {Unorm8, "RGBA", true}},
                               {44, {Unorm8, "BGRA"}},     {50, {Unorm8, "BGRA", true}},
                               {58, {Rgb10a2, "BGRA"}},    {64, {Rgb10a2, "RGBA"}},
                               {70, {Unorm16, "Y"}},       {76, {Half, "Y"}},
                               {77, {Unorm16, "RG"}},      {83, {Half, "RG"}},
                               {84, {Unorm16, "RGB"}},     {90, {Half, "RGB"}},
                               {91, {Unorm16, "RGBA"}},    {97, {Half, "RGBA"}},
                               {100, {Float, "Y"}},        {103, {Float, "RG"}},
                               {106, {Float, "RGB"}},      {109, {Float, "RGBA"}},
                               {122, {R11g11b10f, "RGB"}}, {123, {Rgb9e5, "RGB"}}};

Coding coding_of(PixelType type) {
  switch (type) {
    case PixelType::Uint8:
    case PixelType::Rgbd8:
      return Unorm8;
    case PixelType::Uint16:
      return Unorm16;
    case PixelType::Half:
      return Half;
    case PixelType::Float:
      return Float;
    case PixelType::Rgb10a2:
      return Rgb10a2;
    case PixelType::B10g11r11:
      return R11g11b10f;
    case PixelType::E5b9g9r9:
      return Rgb9e5;
  }
  return Float;
}

uint32_t number_of(std::span<const Numbered> list, PixelType type, int channels, bool srgb) {
  constexpr std::string_view names[] = {"Y", "RG", "RGB", "RGBA"};
  const std::string_view wanted = names[std::clamp(channels, 1, 4) - 1];
  const auto at = std::find_if(list.begin(), list.end(), [&](const Numbered& one) {
    return one.texel.coding == coding_of(type) && one.texel.channels == wanted &&
           one.texel.srgb == srgb;
  });
  if (at == list.end()) return srgb ? number_of(list, type, channels, false) : 0;
  return at->number;
}

std::optional<TexelFormat> texel_of(std::span<const Numbered> list, uint32_t number) {
  for (const Numbered& one : list) {
    if (one.number == number) return one.texel;
  }
  return std::nullopt;
}

}  // namespace

uint32_t dxgi_number(PixelType type, int channels, bool srgb) {
  return number_of(dxgi, type, channels, srgb);
}
std::optional<TexelFormat> dxgi_texel(uint32_t number) { return texel_of(dxgi, number); }
uint32_t vulkan_number(PixelType type, int channels, bool srgb) {
  return number_of(vulkan, type, channels, srgb);
}
std::optional<TexelFormat> vulkan_texel(uint32_t number) { return texel_of(vulkan, number); }

}  // namespace kiln::io
