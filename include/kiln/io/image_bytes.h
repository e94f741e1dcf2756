// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "kiln/io/image_file.h"

namespace kiln {

/// An image that lies in memory: part of another file.
struct ImageBytes {
  std::string name;  ///< for messages
  std::shared_ptr<const std::vector<uint8_t>> bytes;
};

/// As of a file of these contents; not OpenEXR.
/// @error Fault::Input, message "NAME: what is wrong"
FileFacts inspect_image(const ImageBytes& image);
ImageFile read_image(const ImageBytes& image, const ReadLimits& limits = {},
                     const std::vector<std::string>& channels = {});

/// The whole file. @error Fault::Input when it is missing, a folder, empty or may not be read
std::vector<uint8_t> read_bytes(const std::filesystem::path& path);

/// The bytes of a text in base64, whose padding may be missing; nothing where it is none.
/// @source RFC 4648, section 4
std::optional<std::vector<uint8_t>> decoded_base64(std::string_view text);

}  // namespace kiln
