// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "kiln/core/error.h"
#include "kiln/io/image_file.h"
#include "temporary_folder.h"

namespace kiln::test {

/// A budget of a pipeline that leaves bands of a few rows: little more than the process takes
/// itself.
inline constexpr const char* narrow_limits = "limits: { memory: 191MiB }\n";

/// A fresh folder for the length of a test, with ways to put small files into it.
class Workshop : public TemporaryFolder {
 public:
  std::filesystem::path write(const std::string& name, const std::string& text) const {
    const std::filesystem::path path = folder() / name;
    std::filesystem::create_directories(path.parent_path());
    std::ofstream(path, std::ios::binary) << text;
    return path;
  }

  /// An image of one value, three channels.
  std::filesystem::path paint(const std::string& name, float value, PixelType type,
                              Size size = {4, 4}) const {
    const std::filesystem::path path = folder() / name;
    Layers image{size, {}};
    for (const char* channel : {"R", "G", "B"})
      image.layers.push_back({channel, Plane(size, value)});
    write_image(path, image, {type, {}});
    return path;
  }

  /// A folder of metal-rough maps, named after the folder.
  void paint_set(const std::string& folder, const std::string& extension = ".png") const {
    const std::string stem = folder + "/" + std::filesystem::path(folder).filename().string();
    const PixelType type = extension == ".exr" ? PixelType::Half : PixelType::Uint8;
    paint(stem + "_BaseColor" + extension, 0.5f, type);
    paint(stem + "_Roughness" + extension, 0.5f, type);
    paint(stem + "_Metallic" + extension, 0.0f, type);
  }
};

inline std::string text_of(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// The fault and the message of the Error that `work` must throw.
template <class Work>
Error error_of(Work&& work) {
  try {
    work();
  } catch (const Error& error) {
    return error;
  }
  ADD_FAILURE() << "no error was thrown";
  return Error(Fault::Internal, "");
}

template <class Work>
std::string message_of(Work&& work) {
  return error_of(std::forward<Work>(work)).what();
}

}  // namespace kiln::test
