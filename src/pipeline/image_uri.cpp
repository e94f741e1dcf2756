// SPDX-License-Identifier: Apache-2.0
#include "image_uri.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "kiln/core/error.h"
#include "kiln/io/image_bytes.h"

namespace kiln {
namespace {

std::string shortened(const std::string& uri) {
  constexpr size_t most = 60;
  return uri.size() <= most ? uri : uri.substr(0, most) + "...";
}

int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  const char lower = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return lower >= 'a' && lower <= 'f' ? lower - 'a' + 10 : -1;
}

std::string without_escapes(const std::string& uri) {
  std::string text;
  for (size_t i = 0; i < uri.size(); ++i) {
    if (uri[i] != '%') {
      text += uri[i];
      continue;
    }
    const int high = i + 2 < uri.size() ? hex_digit(uri[i + 1]) : -1;
    const int low = high >= 0 ? hex_digit(uri[i + 2]) : -1;
    if (low < 0 || 16 * high + low == 0) {
      throw Error(Fault::Input,
                  fmt::format("uri '{}': broken escape at '{}'", shortened(uri), uri.substr(i, 3)));
    }
    text += static_cast<char>(16 * high + low);
    i += 2;
  }
  return text;
}

// Letters before the first colon, where that comes before any slash.
std::string scheme_of(const std::string& uri) {
  const size_t colon = uri.find(':');
  if (colon == std::string::npos || colon < 2 || uri.find('/') < colon) return "";
  return uri.substr(0, colon);
}

std::vector<uint8_t> bytes_of_data(const std::string& uri) {
  const size_t comma = uri.find(',');
  const std::string head = uri.substr(0, std::min(comma, uri.size()));
  if (comma == std::string::npos || !head.ends_with(";base64")) {
    throw Error(Fault::Input, fmt::format("uri '{}': expected data in base64", shortened(uri)));
  }
  auto bytes = decoded_base64(std::string_view(uri).substr(comma + 1));
  if (!bytes) {
    throw Error(Fault::Input, fmt::format("uri '{}': the data is not base64", shortened(uri)));
  }
  return *std::move(bytes);
}

}  // namespace

UriTarget resolve_uri(const std::string& uri, const std::filesystem::path& folder) {
  const std::string scheme = scheme_of(uri);
  if (scheme == "data") return {{}, bytes_of_data(uri)};
  if (!scheme.empty() || uri.starts_with("//")) {
    throw Error(Fault::Input, fmt::format("uri '{}': would have to be fetched; expected a file "
                                          "beside this one, or data",
                                          shortened(uri)));
  }
  return {(folder / without_escapes(uri)).lexically_normal(), std::nullopt};
}

}  // namespace kiln
