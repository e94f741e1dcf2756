// SPDX-License-Identifier: Apache-2.0
#include <string_view>

#include "byte_text.h"
#include "gl_numbers.h"
#include "ktx_keys.h"
#include "table_files.h"

namespace kiln::io {
namespace {

constexpr std::string_view identifier{"\xabKTX 11\xbb\r\n\x1a\n", 12};

}  // namespace

std::string ktx1_header(const Contents& contents, PixelType type, const Attributes& attributes) {
  const GlNumbers gl = gl_numbers(type, contents.channels);
  const std::string keys = ktx_keys({{"KTXorientation", "S=r,T=d"}}, attributes, "");
  constexpr uint32_t byte_order = 0x04030201, depth = 0, layers = 0;
  std::string bytes(identifier);
  append_words(bytes,
               {byte_order, gl.type, gl.type_bytes, gl.format, gl.internal_format, gl.base_format});
  append_words(bytes, {static_cast<uint32_t>(contents.slice.width),
                       static_cast<uint32_t>(contents.slice.height), depth, layers,
                       static_cast<uint32_t>(contents.faces),
                       static_cast<uint32_t>(contents.levels), static_cast<uint32_t>(keys.size())});
  return bytes += keys;
}

}  // namespace kiln::io
