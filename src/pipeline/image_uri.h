// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace kiln {

/// What a URI in a file refers to: bytes that it holds itself, or a file.
struct UriTarget {
  std::filesystem::path path;
  std::optional<std::vector<uint8_t>> bytes;  ///< of a data: URI
};

/// @param folder  of the file that the URI stands in
/// @error Fault::Input for data that is not in base64, broken escapes, and for what would have to
///        be fetched: only relative references and paths are read
/// @source RFC 2397, RFC 3986
UriTarget resolve_uri(const std::string& uri, const std::filesystem::path& folder);

}  // namespace kiln
