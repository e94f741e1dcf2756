// SPDX-License-Identifier: Apache-2.0
#include "signature.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "env_file.h"
#include "kiln/core/error.h"
#include "kiln/core/names.h"

namespace kiln::io {
namespace {

using std::string_view_literals::operator""sv;

struct Signature {
  std::string_view format;
  std::string_view bytes;
};

constexpr std::array signatures{Signature{"openexr", "\x76\x2f\x31\x01"sv},
                                Signature{"hdr", "#?"sv},
                                Signature{"png", "\x89PNG\r\n\x1a\n"sv},
                                Signature{"jpeg", "\xff\xd8\xff"sv},
                                Signature{"tiff", "II*\0"sv},
                                Signature{"tiff", "MM\0*"sv},
                                Signature{"tiff", "II+\0"sv},
                                Signature{"tiff", "MM\0+"sv},
                                Signature{"bmp", "BM"sv},
                                Signature{"gif", "GIF8"sv},
                                Signature{"psd", "8BPS"sv},
                                Signature{"dds", "DDS "sv},
                                Signature{"ktx", "\xabKTX 11\xbb\r\n\x1a\n"sv},
                                Signature{"ktx2", "\xabKTX 20\xbb\r\n\x1a\n"sv},
                                Signature{"npy", "\x93NUMPY"sv},
                                Signature{"env", env_signature},
                                Signature{"dpx", "SDPX"sv},
                                Signature{"dpx", "XPDS"sv},
                                Signature{"pnm", "P1"sv},
                                Signature{"pnm", "P2"sv},
                                Signature{"pnm", "P3"sv},
                                Signature{"pnm", "P4"sv},
                                Signature{"pnm", "P5"sv},
                                Signature{"pnm", "P6"sv},
                                Signature{"pnm", "PF"sv},
                                Signature{"pnm", "Pf"sv}};

bool is_webp(std::string_view first) {
  return first.starts_with("RIFF"sv) && first.size() >= 12 && first.substr(8, 4) == "WEBP"sv;
}

std::string shown(ByteView first) {
  std::string text;
  for (const uint8_t byte : first.first(std::min<size_t>(first.size(), 8))) {
    text += fmt::format("{}{:02x}", text.empty() ? "" : " ", byte);
  }
  return text;
}

}  // namespace

std::optional<std::string> known_format(const std::filesystem::path& path, ByteView first) {
  const std::string_view text(reinterpret_cast<const char*>(first.data()), first.size());
  for (const Signature& signature : signatures) {
    if (text.starts_with(signature.bytes)) return std::string(signature.format);
  }
  if (is_webp(text)) return "webp";
  if (kebab(path.extension().string()) == ".tga") return "targa";
  return std::nullopt;
}

std::string format_by_contents(const std::filesystem::path& path, ByteView first) {
  if (auto format = known_format(path, first)) return *format;
  throw Error(
      Fault::Input,
      fmt::format("{}: not an image of a known format (it begins with {}; expected OpenEXR, "
                  "Radiance HDR, PNG, JPEG, TIFF, ...)",
                  path.string(), shown(first)));
}

}  // namespace kiln::io
