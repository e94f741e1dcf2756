// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "kiln/io/image_file.h"

namespace kiln::io {

/// R, G, B as the four bytes of PixelType::Rgbd8, scaled to [0,1] and not yet rounded. Clamped to
/// [0, 255] and counted, as `clamped` does.
std::array<float, 4> rgbd_texel(const std::array<float, 3>& color, WriteFacts& facts);

/// The reverse; not finite where the divisor is 0.
std::array<float, 3> rgbd_color(const std::array<float, 4>& texel);

}  // namespace kiln::io
