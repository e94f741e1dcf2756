// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "kiln/io/image_file.h"

namespace kiln::io {

/// Whether a texel of this type is one number of 32 bits, whose channels are no whole bytes.
bool is_packed(PixelType type);

/// Bytes of one sample; of a whole texel where it is packed.
size_t sample_bytes(PixelType type);

/// Stored sample -> float: integers divided by their largest value (correctly rounded), half exact.
/// @valid type is none that packs a texel, nor Rgbd8
/// @param stored  samples of `type`, the first of the row at the front
/// @param step    [sample] from one to the next
void load_samples(const std::byte* stored, PixelType type, size_t step, std::span<float> row);

/// float -> stored sample: integers round(v * max), half rounded to nearest; finite values beyond
/// the range are clamped and counted in `facts`, NaN becomes 0 in integers and is counted.
void store_samples(std::span<const float> row, PixelType type, size_t step, std::byte* stored,
                   WriteFacts& facts);

/// v clamped to [0, max]; finite values beyond are counted in `facts`. NaN becomes 0 and is
/// counted.
float clamped(float value, float max, WriteFacts& facts);

/// round(v * max), v clamped to [0,1] and counted as above.
uint32_t quantised(float value, uint32_t max, WriteFacts& facts);

/// Notes a clamped value.
void count_clamped(float value, WriteFacts& facts);

/// @error Fault::Input when a header claims more than is allowed or not one texel
void require_within(const ReadLimits& limits, long long width, long long height,
                    long long channels);

/// The same for the faces of all levels together, each level half as large as the one before.
/// @error as require_within, and for more levels than such a size has
void require_levels_within(const ReadLimits& limits, long long width, long long height,
                           long long levels, long long faces);

/// Where a channel stands in Layers: R G B (or Y), then A, then all others as they came.
int channel_rank(std::string_view name);

/// Y; R G; R G B; R G B A; beyond that channel0, channel1, ...
std::vector<std::string> usual_channel_names(int count);

}  // namespace kiln::io
