// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "attribute_lines.h"
#include "kiln/core/error.h"
#include "radiance_hdr.h"
#include "samples.h"

namespace kiln::io {
namespace {

using Rgbe = std::array<uint8_t, 4>;

constexpr float largest = 255.0f * 0x1p119f;  // mantissa 255, exponent 255

// What RGBE can hold of a value: not negative, not above `largest`.
float held(float value, WriteFacts& facts) {
  if (std::isnan(value)) {
    ++facts.not_a_number;
    return 0.0f;
  }
  if (std::isfinite(value) && (value < 0.0f || value > largest)) count_clamped(value, facts);
  return std::clamp(value, 0.0f, largest);
}

// max = m 2^k with m in [1/2, 1): mantissas are value * 2^(8 - k), exponent k + 128. Where the
// largest would round to 256, the exponent is one more.
Rgbe rgbe(float r, float g, float b) {
  const float max = std::max({r, g, b});
  int k = 0;
  if (std::lround(std::frexp(max, &k) * 256.0f) == 256) ++k;
  if (max == 0.0f || k < -127) return {0, 0, 0, 0};
  const auto mantissa = [k](float value) {
    return static_cast<uint8_t>(std::lround(std::ldexp(value, 8 - k)));
  };
  return {mantissa(r), mantissa(g), mantissa(b), static_cast<uint8_t>(k + 128)};
}

size_t run_length(const std::vector<Rgbe>& line, size_t component, size_t x) {
  size_t end = x + 1;
  while (end < line.size() && end - x < 127 && line[end][component] == line[x][component]) ++end;
  return end - x;
}

void append_component(const std::vector<Rgbe>& line, size_t component, std::string& bytes) {
  constexpr size_t shortest_run = 4;
  constexpr size_t longest_literal = 128;
  for (size_t x = 0; x < line.size();) {
    if (const size_t run = run_length(line, component, x); run >= shortest_run) {
      bytes += static_cast<char>(128 + run);
      bytes += static_cast<char>(line[x][component]);
      x += run;
      continue;
    }
    size_t end = x + 1;
    while (end < line.size() && end - x < longest_literal &&
           run_length(line, component, end) < shortest_run) {
      ++end;
    }
    bytes += static_cast<char>(end - x);
    for (; x < end; ++x) bytes += static_cast<char>(line[x][component]);
  }
}

// A flat line must not look like another encoding: a pixel (2, 2, *, *) at the front, or
// (1, 1, 1, *) anywhere. Such a normalised pixel has a mantissa of 128 or more, so none does.
void append_line(const std::vector<Rgbe>& line, std::string& bytes) {
  const size_t length = line.size();
  if (length < 8 || length > 32767) {
    for (const Rgbe& pixel : line) bytes.append(pixel.begin(), pixel.end());
    return;
  }
  bytes += "\x02\x02";
  bytes += static_cast<char>(length >> 8);
  bytes += static_cast<char>(length & 255);
  for (size_t component = 0; component < 4; ++component) append_component(line, component, bytes);
}

class HdrEncoder : public BandEncoder {
 public:
  explicit HdrEncoder(const FileToWrite& file)
      : file_(file), line_(static_cast<size_t>(file.size.width)) {
    std::string head = "#?RADIANCE\n";
    for (const auto& [name, text] : file.options.attributes) head += comment_line("# ", name, text);
    head +=
        fmt::format("FORMAT=32-bit_rle_rgbe\n\n-Y {} +X {}\n", file.size.height, file.size.width);
    file_.out.append(head);
  }

  void add(const StoredPlanes& band) override {
    std::string bytes;
    for (int y = 0; y < band.size().height; ++y) {
      for (int x = 0; x < file_.size.width; ++x) line_[static_cast<size_t>(x)] = pixel(band, x, y);
      bytes.clear();
      append_line(line_, bytes);
      file_.out.append(bytes);
    }
  }

  void finish() override {}

 private:
  Rgbe pixel(const StoredPlanes& band, int x, int y) {
    std::array<float, 3> texel{};
    for (size_t c = 0; c < band.planes.size(); ++c) {
      if (band.planes[c] != nullptr) texel[c] = held(band.planes[c]->at(x, y), file_.facts);
    }
    if (band.planes.size() == 1) texel = {texel[0], texel[0], texel[0]};
    return rgbe(texel[0], texel[1], texel[2]);
  }

  FileToWrite file_;
  std::vector<Rgbe> line_;
};

}  // namespace

std::unique_ptr<BandEncoder> hdr_encoder(const FileToWrite& file) {
  return std::make_unique<HdrEncoder>(file);
}

}  // namespace kiln::io

namespace kiln {

Layers coded_as_hdr(const Layers& image) {
  if (image.layers.size() != 3) {
    throw Error(Fault::Usage,
                fmt::format("found {} layers; Radiance HDR shares an exponent among 3",
                            image.layers.size()));
  }
  Layers result = image;
  WriteFacts facts;
  for (int y = 0; y < image.size.height; ++y) {
    for (int x = 0; x < image.size.width; ++x) {
      std::array<float, 3> value{};
      for (size_t c = 0; c < 3; ++c) value[c] = io::held(image.layers[c].plane.at(x, y), facts);
      const io::Rgbe texel = io::rgbe(value[0], value[1], value[2]);
      for (size_t c = 0; c < 3; ++c) {
        result.layers[c].plane.at(x, y) =
            texel[3] == 0 ? 0.0f : std::ldexp(static_cast<float>(texel[c]), texel[3] - 136);
      }
    }
  }
  return result;
}

}  // namespace kiln
