// SPDX-License-Identifier: Apache-2.0
#include "samples.h"

#include <Imath/half.h>
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <string_view>
#include <type_traits>

#include "kiln/core/error.h"

namespace kiln::io {
namespace {

constexpr float half_max = 65504.0f;

template <class Stored>
float loaded(Stored value) {
  if constexpr (std::is_integral_v<Stored>) {
    return static_cast<float>(value) / static_cast<float>(std::numeric_limits<Stored>::max());
  } else {
    return static_cast<float>(value);
  }
}

template <class Stored>
Stored narrowed_to(float value, WriteFacts& facts) {
  return static_cast<Stored>(quantised(value, std::numeric_limits<Stored>::max(), facts));
}

half narrowed(float value, WriteFacts& facts) {
  if (std::isfinite(value) && std::abs(value) > half_max) {
    count_clamped(value, facts);
    return half(std::copysign(half_max, value));
  }
  return half(value);
}

template <class Stored>
void load_row(const std::byte* stored, size_t step, std::span<float> row) {
  for (size_t x = 0; x < row.size(); ++x) {
    Stored value;
    std::memcpy(&value, stored + x * step * sizeof(Stored), sizeof value);
    row[x] = loaded(value);
  }
}

template <class Stored, class Narrow>
void store_row(std::span<const float> row, size_t step, std::byte* stored, Narrow narrow) {
  for (size_t x = 0; x < row.size(); ++x) {
    const Stored value = narrow(row[x]);
    std::memcpy(stored + x * step * sizeof(Stored), &value, sizeof value);
  }
}

// Whether none is beyond the range, nor NaN: then none has to be looked at one by one.
bool all_within(std::span<const float> row, float least, float most) {
  bool within = true;
  for (const float value : row) within &= static_cast<bool>((value >= least) & (value <= most));
  return within;
}

template <class Stored>
Stored rounded(float value) {
  return static_cast<Stored>(
      std::fma(static_cast<double>(value), std::numeric_limits<Stored>::max(), 0.5));
}

template <class Stored>
void store_integers(std::span<const float> row, size_t step, std::byte* stored, WriteFacts& facts) {
  if (all_within(row, 0.0f, 1.0f)) return store_row<Stored>(row, step, stored, rounded<Stored>);
  store_row<Stored>(row, step, stored,
                    [&](float value) { return narrowed_to<Stored>(value, facts); });
}

void store_halves(std::span<const float> row, size_t step, std::byte* stored, WriteFacts& facts) {
  if (all_within(row, -half_max, half_max)) {
    return store_row<half>(row, step, stored, [](float value) { return half(value); });
  }
  store_row<half>(row, step, stored, [&](float value) { return narrowed(value, facts); });
}

}  // namespace

float clamped(float value, float max, WriteFacts& facts) {
  if (std::isnan(value)) {
    ++facts.not_a_number;
    return 0.0f;
  }
  const bool inside = value >= 0.0f && value <= max;
  if (!inside && std::isfinite(value)) count_clamped(value, facts);
  return std::clamp(value, 0.0f, max);
}

uint32_t quantised(float value, uint32_t max, WriteFacts& facts) {
  const auto inside = static_cast<double>(clamped(value, 1.0f, facts));
  return static_cast<uint32_t>(std::lround(inside * max));
}

bool is_packed(PixelType type) {
  return type == PixelType::Rgb10a2 || type == PixelType::B10g11r11 || type == PixelType::E5b9g9r9;
}

size_t sample_bytes(PixelType type) {
  switch (type) {
    case PixelType::Uint8:
      return 1;
    case PixelType::Uint16:
    case PixelType::Half:
      return 2;
    case PixelType::Float:
    case PixelType::Rgb10a2:
    case PixelType::Rgbd8:
    case PixelType::B10g11r11:
    case PixelType::E5b9g9r9:
      return 4;
  }
  return 4;
}

void load_samples(const std::byte* stored, PixelType type, size_t step, std::span<float> row) {
  switch (type) {
    case PixelType::Uint8:
      return load_row<uint8_t>(stored, step, row);
    case PixelType::Uint16:
      return load_row<uint16_t>(stored, step, row);
    case PixelType::Half:
      return load_row<half>(stored, step, row);
    case PixelType::Float:
    case PixelType::Rgb10a2:
    case PixelType::Rgbd8:
    case PixelType::B10g11r11:
    case PixelType::E5b9g9r9:
      return load_row<float>(stored, step, row);
  }
}

void store_samples(std::span<const float> row, PixelType type, size_t step, std::byte* stored,
                   WriteFacts& facts) {
  switch (type) {
    case PixelType::Uint8:
      return store_integers<uint8_t>(row, step, stored, facts);
    case PixelType::Uint16:
      return store_integers<uint16_t>(row, step, stored, facts);
    case PixelType::Half:
      return store_halves(row, step, stored, facts);
    case PixelType::Float:
    case PixelType::Rgb10a2:
    case PixelType::Rgbd8:
    case PixelType::B10g11r11:
    case PixelType::E5b9g9r9:
      return store_row<float>(row, step, stored, [](float value) { return value; });
  }
}

void count_clamped(float value, WriteFacts& facts) {
  ++facts.clamped;
  facts.largest_clamped = std::max(facts.largest_clamped, std::abs(static_cast<double>(value)));
}

void require_within(const ReadLimits& limits, long long width, long long height,
                    long long channels) {
  if (width < 1 || height < 1 || channels < 1) {
    throw Error(Fault::Input, fmt::format("the header claims {} x {} texels and {} channels", width,
                                          height, channels));
  }
  if (width > limits.max_texels / height) {
    throw Error(Fault::Input,
                fmt::format("the header claims {} x {} texels; more than {} are not read", width,
                            height, limits.max_texels));
  }
  if (channels > limits.max_channels) {
    throw Error(Fault::Input,
                fmt::format("the header claims {} channels; more than {} are not read", channels,
                            limits.max_channels));
  }
}

void require_levels_within(const ReadLimits& limits, long long width, long long height,
                           long long levels, long long faces) {
  require_within(limits, width, height, 1);
  const auto edge = static_cast<unsigned long long>(std::max(width, height));
  if (levels < 1 || levels > static_cast<long long>(std::bit_width(edge))) {
    throw Error(Fault::Input,
                fmt::format("the header claims {} mip levels of {} x {} texels, which have 1 to {}",
                            levels, width, height, std::bit_width(edge)));
  }
  long long texels = 0;
  for (long long level = 0; level < levels; ++level) {
    texels += std::max(1LL, width >> level) * std::max(1LL, height >> level);
  }
  if (faces < 1 || texels > limits.max_texels / faces) {
    throw Error(
        Fault::Input,
        fmt::format("the header claims {} levels of {} faces with {} x {} texels; more than "
                    "{} texels in all are not read",
                    levels, faces, width, height, limits.max_texels));
  }
}

int channel_rank(std::string_view name) {
  constexpr std::string_view first = "RGBYA";
  const size_t at = name.size() == 1 ? first.find(name) : std::string_view::npos;
  return static_cast<int>(std::min(at, first.size()));
}

std::vector<std::string> usual_channel_names(int count) {
  if (count == 1) return {"Y"};
  std::vector<std::string> names;
  names.reserve(static_cast<size_t>(count));
  for (int c = 0; c < count; ++c) {
    names.push_back(count <= 4 ? std::string(1, "RGBA"[c]) : fmt::format("channel{}", c));
  }
  return names;
}

}  // namespace kiln::io
