// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string_view>

#include "byte_text.h"
#include "format_numbers.h"
#include "kiln/core/error.h"
#include "samples.h"
#include "table_files.h"

namespace kiln::io {
namespace {

constexpr std::string_view identifier{"\xabKTX 20\xbb\r\n\x1a\n", 12};
constexpr size_t header_bytes = 12 + 9 * 4 + 4 * 4 + 2 * 8;
constexpr size_t level_index_bytes = 3 * 8;

struct Sample {
  uint32_t bit = 0;
  uint32_t bits = 0;
  uint32_t channel = 0;
};

std::vector<Sample> samples_of(PixelType type, int channels) {
  constexpr uint32_t alpha = 15;
  if (type == PixelType::Rgb10a2) return {{0, 10, 0}, {10, 10, 1}, {20, 10, 2}, {30, 2, alpha}};
  std::vector<Sample> samples;
  const auto bits = static_cast<uint32_t>(8 * sample_bytes(type));
  for (uint32_t c = 0; c < static_cast<uint32_t>(channels); ++c) {
    samples.push_back({c * bits, bits, c == 3 ? alpha : c});
  }
  return samples;
}

// One basic block: linear RGB of no stated primaries. Floats span [-1, 1], integers [0, max].
std::string descriptor(PixelType type, int channels) {
  const std::vector<Sample> samples = samples_of(type, channels);
  const bool is_float = type == PixelType::Half || type == PixelType::Float;
  const auto block_bytes = static_cast<uint32_t>(24 + 16 * samples.size());
  constexpr uint32_t version = 2, model_rgbsda = 1, transfer_linear = 1;
  constexpr uint32_t signed_float = 0xc0;
  std::string bytes;
  const Sample& last = samples.back();
  append_words(bytes, {4 + block_bytes, 0, version | block_bytes << 16,
                       model_rgbsda | transfer_linear << 16, 0, (last.bit + last.bits) / 8, 0});
  for (const Sample& sample : samples) {
    const uint32_t kind = sample.channel | (is_float ? signed_float : 0);
    append_words(bytes,
                 {sample.bit | (sample.bits - 1) << 16 | kind << 24, 0, is_float ? 0xbf800000u : 0u,
                  is_float ? 0x3f800000u : (1u << sample.bits) - 1u});
  }
  return bytes;
}

// Keys in the order of their bytes, as the format demands.
std::map<std::string, std::string> keys_and_values(int depth, const Attributes& attributes) {
  std::map<std::string, std::string> keys{{"KTXorientation", depth > 1 ? "rdi" : "rd"},
                                          {"KTXwriter", "kiln"}};
  bool software_seen = false;
  for (const auto& [name, text] : attributes) {
    if (name == "Software" && !software_seen) {
      software_seen = true;
      keys["KTXwriter"] = text;
      continue;
    }
    const bool own = name.empty() || name.starts_with("KTX") || name.starts_with("ktx");
    if (own || name.find('\0') != std::string::npos || !keys.emplace(name, text).second) {
      throw Error(Fault::Usage,
                  fmt::format("metadata name '{}' is empty, used twice or the format's own", name));
    }
  }
  return keys;
}

std::string key_value_block(int depth, const Attributes& attributes) {
  std::string bytes;
  for (const auto& [name, text] : keys_and_values(depth, attributes)) {
    append_little(bytes, name.size() + text.size() + 2, 4);
    bytes.append(name).append(1, '\0').append(text).append(1, '\0');
    pad_to(bytes, 4);
  }
  return bytes;
}

uint32_t sample_type_bytes(PixelType type) { return static_cast<uint32_t>(sample_bytes(type)); }

}  // namespace

std::string ktx2_header(const Contents& contents, PixelType type, const Attributes& attributes,
                        size_t texel_bytes) {
  const std::string format = descriptor(type, contents.channels);
  const std::string keys = key_value_block(contents.depth, attributes);
  const size_t format_at = header_bytes + level_index_bytes;
  const size_t keys_at = format_at + format.size();
  const size_t texel = texel_bytes / static_cast<size_t>(area(contents.slice) * contents.depth);
  size_t step = texel;
  while (step % 4 != 0) step += texel;
  const size_t texels_at = (keys_at + keys.size() + step - 1) / step * step;

  std::string bytes(identifier);
  append_words(bytes, {vulkan_number(type, contents.channels), sample_type_bytes(type),
                       static_cast<uint32_t>(contents.slice.width),
                       static_cast<uint32_t>(contents.slice.height),
                       contents.depth > 1 ? static_cast<uint32_t>(contents.depth) : 0u});
  constexpr uint32_t layers = 0, faces = 1, levels = 1, no_supercompression = 0;
  append_words(bytes, {layers, faces, levels, no_supercompression});
  append_words(bytes, {static_cast<uint32_t>(format_at), static_cast<uint32_t>(format.size()),
                       static_cast<uint32_t>(keys_at), static_cast<uint32_t>(keys.size())});
  append_words(bytes, {0, 0, 0, 0});
  for (const size_t number : {texels_at, texel_bytes, texel_bytes}) {
    append_little(bytes, number, 8);
  }
  bytes.append(format).append(keys);
  bytes.resize(texels_at, '\0');
  return bytes;
}

std::string encode_ktx2(const Contents& contents, PixelType type, const Attributes& attributes,
                        const std::string& texels) {
  return ktx2_header(contents, type, attributes, texels.size()) += texels;
}

}  // namespace kiln::io
