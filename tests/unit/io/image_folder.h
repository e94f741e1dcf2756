// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <string>
#include <vector>

#include "kiln/core/error.h"
#include "kiln/io/image_file.h"
#include "support/faults.h"
#include "support/temporary_folder.h"

namespace kiln::test {

namespace fs = std::filesystem;

/// A test with a fresh folder of its own.
class ImageFolder : public testing::Test {
 protected:
  fs::path write_bytes(const std::string& name, const std::string& bytes) const {
    std::ofstream(folder / name, std::ios::binary) << bytes;
    return folder / name;
  }
  static std::string bytes_of(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  std::set<std::string> names() const {
    std::set<std::string> result;
    for (const auto& entry : fs::directory_iterator(folder)) {
      result.insert(entry.path().filename().string());
    }
    return result;
  }

  const TemporaryFolder own;
  const fs::path folder = own.folder();
};

/// A file name of this format.
inline std::string named(std::string stem, const WritableFormat& format) {
  return stem.append(format.extensions.front());
}

/// The formats that keep names or colour, and that nothing but an image is read from.
inline std::vector<WritableFormat> picture_formats() {
  std::vector<WritableFormat> formats;
  for (const WritableFormat& format : writable_formats()) {
    if (format.name == "dds") break;
    formats.push_back(format);
  }
  return formats;
}

/// The formats of tables, which come after the pictures in the list.
inline std::vector<WritableFormat> table_formats() {
  return {writable_formats().begin() + static_cast<std::ptrdiff_t>(picture_formats().size()),
          writable_formats().end()};
}

/// Planes of a fixed pattern in [0,1], no two alike.
inline Layers pattern(Size size, const std::vector<std::string>& names) {
  Layers image = make_layers(size, names);
  for (size_t c = 0; c < names.size(); ++c) {
    for (int y = 0; y < size.height; ++y) {
      for (int x = 0; x < size.width; ++x) {
        const int n = (x * 7 + y * 13 + static_cast<int>(c) * 29) % 256;
        image.layers[c].plane.at(x, y) = static_cast<float>(n) / 255.0f;
      }
    }
  }
  return image;
}

inline std::vector<std::string> channel_names(const Layers& image) {
  std::vector<std::string> names;
  for (const Layer& layer : image.layers) names.push_back(layer.name);
  return names;
}

}  // namespace kiln::test
