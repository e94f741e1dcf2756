// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "file_bytes.h"
#include "kiln/core/size.h"

namespace kiln::io {

/// What a PNG says of its colours before its pixels begin: the sRGB chunk, an ICC profile, or a
/// gamma; a name of the built-in colour configuration. @source PNG (third edition), 11.3.2
std::optional<std::string> png_color_tag(ByteView bytes);

struct PngHeader {
  Size size;
  int bits_per_texel = 0;
};
/// Without decoding anything; nothing where there is no such header. @source ibid., 11.2.2
std::optional<PngHeader> png_header(ByteView bytes);

/// Whether so many bytes of deflated data can hold the pixels that the header claims: deflate
/// never shrinks by more than 1032. @source RFC 1951 (258 bytes by 2 bits)
bool png_may_hold_its_pixels(const PngHeader& header, size_t bytes);

/// Called now and then as a check walks through a file: what lies behind it may leave the memory.
using LetGo = std::function<void()>;

/// Whether a PNG's chunks run to its end.
bool png_is_complete(
    ByteView bytes, const LetGo& let_go = [] {});

/// Whether a DDS is as long as the densest of its encodings (BC1, half a byte a texel) needs for
/// the size that the header claims. @source Microsoft, DDS_HEADER
bool dds_may_hold_its_pixels(ByteView bytes);

/// Whether a JPEG's markers run to the end of the image. Decoders fill what is missing with grey
/// and go on. @source ITU-T T.81, annex B
bool jpeg_is_complete(
    ByteView bytes, const LetGo& let_go = [] {});

}  // namespace kiln::io
