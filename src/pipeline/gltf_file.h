// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>

#include "json_at.h"
#include "kiln/io/image_bytes.h"

namespace kiln {

/// A glTF 2.0 asset: its JSON, and the images that it refers to or holds.
class GltfFile {
 public:
  /// @error Fault::Input for broken JSON or containers, another version, and extensions that are
  ///        required but not known
  explicit GltfFile(const std::filesystem::path& path);

  JsonAt root() const { return {json_, path_.string()}; }
  const std::filesystem::path& path() const { return path_; }

  /// Where an image is: a file, or bytes under a name made of this file's.
  struct Image {
    std::filesystem::path path;
    ImageBytes embedded;
  };
  /// The image of a texture. @error Fault::Input naming what is missing or unknown
  Image image_of(const JsonAt& texture);

 private:
  std::vector<uint8_t> bytes_of_view(const JsonAt& image);
  const std::vector<uint8_t>& buffer(const JsonAt& view);
  Image image(const JsonAt& image);
  void read_binary(const std::vector<uint8_t>& bytes);
  void check_version() const;
  void check_extensions() const;

  std::filesystem::path path_;
  Json json_;
  std::vector<uint8_t> binary_;  ///< of the chunk BIN
  std::map<size_t, std::vector<uint8_t>> buffers_;
  std::map<std::string, Image> images_;
};

}  // namespace kiln
