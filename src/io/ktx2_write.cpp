// SPDX-License-Identifier: Apache-2.0
#include <numeric>
#include <string_view>

#include "byte_text.h"
#include "format_numbers.h"
#include "ktx_keys.h"
#include "samples.h"
#include "table_files.h"
#include "texel_pack.h"

namespace kiln::io {
namespace {

constexpr std::string_view identifier{"\xabKTX 20\xbb\r\n\x1a\n", 12};
constexpr size_t header_bytes = 12 + 9 * 4 + 4 * 4 + 2 * 8;
constexpr size_t level_index_bytes = 3 * 8;

// What some bits of a texel are.
struct Sample {
  uint32_t bit = 0;
  uint32_t bits = 0;
  uint32_t kind = 0;   // channel and qualifiers
  uint32_t lower = 0;  // the bits, or the float, that stand for 0 (or -1)
  uint32_t upper = 0;  // for 1
};

constexpr uint32_t alpha_channel = 15;
constexpr uint32_t is_float = 0x80, is_signed = 0x40, is_exponent = 0x20, is_linear = 0x10;
constexpr uint32_t float_one = 0x3f800000, float_minus_one = 0xbf800000;

Sample integer(uint32_t bit, uint32_t bits, uint32_t channel) {
  return {bit, bits, channel, 0, (1u << bits) - 1u};
}

// The mantissa of one channel, with the upper number that Khronos' descriptors of this format have,
// and the exponent of all.
void add_shared(uint32_t channel, std::vector<Sample>& samples) {
  constexpr uint32_t mantissa_bits = 9, exponent_bit = 27, bias = 15, largest = 31;
  constexpr uint32_t mantissa_upper = 8448;
  samples.push_back({mantissa_bits * channel, mantissa_bits, channel, 0, mantissa_upper});
  samples.push_back({exponent_bit, 5, channel | is_exponent, bias, largest});
}

std::vector<Sample> samples_of(PixelType type, int channels) {
  std::vector<Sample> samples;
  if (type == PixelType::Rgb10a2) {
    return {integer(0, 10, 0), integer(10, 10, 1), integer(20, 10, 2),
            integer(30, 2, alpha_channel)};
  }
  if (type == PixelType::B10g11r11) {
    return {{0, 11, 0 | is_float, 0, float_one},
            {11, 11, 1 | is_float, 0, float_one},
            {22, 10, 2 | is_float, 0, float_one}};
  }
  if (type == PixelType::E5b9g9r9) {
    for (uint32_t c = 0; c < 3; ++c) add_shared(c, samples);
    return samples;
  }
  const bool floats = type == PixelType::Half || type == PixelType::Float;
  const auto bits = static_cast<uint32_t>(8 * sample_bytes(type));
  for (uint32_t c = 0; c < static_cast<uint32_t>(channels); ++c) {
    const uint32_t channel = c == 3 ? alpha_channel : c;
    samples.push_back(
        floats ? Sample{c * bits, bits, channel | is_float | is_signed, float_minus_one, float_one}
               : integer(c * bits, bits, channel));
  }
  return samples;
}

// One basic block: RGB, its primaries only where they are known. Floats span [-1, 1] or [0, 1],
// integers [0, max]. Alpha is linear beside sRGB too.
std::string descriptor(PixelType type, int channels, ColorTag tag) {
  std::vector<Sample> samples = samples_of(type, channels);
  const bool srgb = tag == ColorTag::Srgb;
  if (srgb && channels == 4) samples.back().kind |= is_linear;
  const auto block_bytes = static_cast<uint32_t>(24 + 16 * samples.size());
  constexpr uint32_t version = 2, model_rgbsda = 1;
  const uint32_t transfer = srgb ? 2 : 1;
  const uint32_t primaries = tag == ColorTag::None ? 0 : 1;  // of BT.709
  std::string bytes;
  append_words(bytes, {4 + block_bytes, 0, version | block_bytes << 16,
                       model_rgbsda | primaries << 8 | transfer << 16, 0,
                       static_cast<uint32_t>(packed_texel_bytes(type, channels)), 0});
  for (const Sample& sample : samples) {
    append_words(bytes, {sample.bit | (sample.bits - 1) << 16 | sample.kind << 24, 0, sample.lower,
                         sample.upper});
  }
  return bytes;
}

uint32_t sample_type_bytes(PixelType type) { return static_cast<uint32_t>(sample_bytes(type)); }

size_t aligned(size_t at, size_t step) { return (at + step - 1) / step * step; }

// Of each level, the largest first: where it stands, its bytes, and those of its texels.
std::string level_index(const std::vector<LevelBytes>& levels, size_t first, size_t step) {
  std::vector<size_t> places(levels.size());
  for (size_t p = levels.size(); p-- > 0;) {
    places[p] = first;
    first = aligned(first + levels[p].stored, step);
  }
  std::string bytes;
  for (size_t p = 0; p < levels.size(); ++p) {
    for (const size_t number : {places[p], levels[p].stored, levels[p].texels}) {
      append_little(bytes, number, 8);
    }
  }
  return bytes;
}

}  // namespace

size_t ktx2_alignment(const Contents& contents, PixelType type, Supercompression supercompression) {
  if (supercompression != Supercompression::None) return 1;
  return std::lcm(packed_texel_bytes(type, contents.channels), size_t{4});
}

std::string ktx2_header(const Contents& contents, PixelType type,
                        const Ktx2Description& description, const std::vector<LevelBytes>& levels) {
  const ColorTag tag = contents.srgb ? ColorTag::Srgb : description.color_tag;
  const std::string format = descriptor(type, contents.channels, tag);
  const std::string keys = ktx_keys({{"KTXorientation", contents.depth > 1 ? "rdi" : "rd"}},
                                    description.attributes, "KTXwriter");
  const size_t format_at = header_bytes + levels.size() * level_index_bytes;
  const size_t keys_at = format_at + format.size();
  const size_t step = ktx2_alignment(contents, type, description.supercompression);
  const size_t texels_at = aligned(keys_at + keys.size(), step);
  constexpr uint32_t layers = 0, zstandard = 2;
  std::string bytes(identifier);
  append_words(bytes, {vulkan_number(type, contents.channels, contents.srgb),
                       sample_type_bytes(type), static_cast<uint32_t>(contents.slice.width),
                       static_cast<uint32_t>(contents.slice.height),
                       contents.depth > 1 ? static_cast<uint32_t>(contents.depth) : 0u});
  append_words(bytes,
               {layers, static_cast<uint32_t>(contents.faces), static_cast<uint32_t>(levels.size()),
                description.supercompression == Supercompression::Zstd ? zstandard : 0});
  append_words(bytes, {static_cast<uint32_t>(format_at), static_cast<uint32_t>(format.size()),
                       static_cast<uint32_t>(keys_at), static_cast<uint32_t>(keys.size())});
  append_words(bytes, {0, 0, 0, 0});
  bytes.append(level_index(levels, texels_at, step)).append(format).append(keys);
  bytes.resize(texels_at, '\0');
  return bytes;
}

std::string ktx2_header(const Contents& contents, PixelType type, const Attributes& attributes,
                        size_t texel_bytes) {
  return ktx2_header(contents, type, {.attributes = attributes}, {{texel_bytes, texel_bytes}});
}

}  // namespace kiln::io
