// SPDX-License-Identifier: Apache-2.0
#include "gl_numbers.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <string_view>

#include "kiln/core/error.h"
#include "samples.h"

namespace kiln::io {
namespace {

using enum Coding;

constexpr uint32_t half_type = 0x140b, float_type = 0x1406;
constexpr uint32_t packed_floats = 0x8c3a;  // the internal format, which cmgen has for the type too
constexpr uint32_t shared_exponent = 0x8c3d, shared_exponent_type = 0x8c3e;
constexpr uint32_t rgb = 0x1907;

struct NamedType {
  uint32_t number;
  Coding coding;
};
constexpr NamedType types[] = {{0x1401, Unorm8},     {0x1403, Unorm16},
                               {half_type, Half},    {float_type, Float},
                               {0x8368, Rgb10a2},    {packed_floats, R11g11b10f},
                               {0x8c3b, R11g11b10f}, {shared_exponent_type, Rgb9e5}};

struct OrderedFormat {
  uint32_t number;
  std::string_view channels;
};
// The sized numbers stand in files of older tools.
constexpr OrderedFormat formats[] = {
    {0x1903, "Y"}, {0x1909, "Y"},   {0x190a, "YA"},   {0x1906, "A"},    {0x8227, "RG"},
    {rgb, "RGB"},  {0x80e0, "BGR"}, {0x1908, "RGBA"}, {0x80e1, "BGRA"}, {packed_floats, "RGB"}};

}  // namespace

GlNumbers gl_numbers(PixelType type, int channels) {
  if (type == PixelType::B10g11r11) return {packed_floats, 4, rgb, packed_floats, rgb};
  if (type == PixelType::E5b9g9r9) return {shared_exponent_type, 4, rgb, shared_exponent, rgb};
  constexpr uint32_t orders[] = {0x1903, 0x8227, rgb, 0x1908};
  constexpr uint32_t halves[] = {0x822d, 0x822f, 0x881b, 0x881a};
  constexpr uint32_t floats[] = {0x822e, 0x8230, 0x8815, 0x8814};
  const auto at = static_cast<size_t>(std::clamp(channels, 1, 4) - 1);
  const bool is_half = type == PixelType::Half;
  return {is_half ? half_type : float_type, static_cast<uint32_t>(sample_bytes(type)), orders[at],
          is_half ? halves[at] : floats[at], orders[at]};
}

TexelFormat gl_texel(uint32_t type, uint32_t format) {
  const auto coding = std::find_if(std::begin(types), std::end(types),
                                   [&](const NamedType& one) { return one.number == type; });
  const auto order = std::find_if(std::begin(formats), std::end(formats),
                                  [&](const OrderedFormat& one) { return one.number == format; });
  if (coding == std::end(types) || order == std::end(formats)) {
    throw Error(Fault::Input,
                fmt::format("texels of OpenGL type 0x{:x} and format 0x{:x} are not read, expected "
                            "8 or 16 bit, half, float or packed ones",
                            type, format));
  }
  const TexelFormat texel{coding->coding, order->channels};
  const size_t wanted = texel.coding == Rgb10a2 ? 4 : 3;
  if (is_packed(coded_as(texel.coding)) && texel.channels.size() != wanted) {
    throw Error(Fault::Input,
                fmt::format("texels of OpenGL type 0x{:x} have no format 0x{:x}", type, format));
  }
  return texel;
}

}  // namespace kiln::io
