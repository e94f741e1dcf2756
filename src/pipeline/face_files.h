// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>

namespace kiln {

/// Six files that hold the faces of a cube.
struct FaceFiles {
  std::array<std::filesystem::path, 6> paths;  ///< in the order of CubeFace
  std::string pattern;                         ///< their name, with <FACE>
  std::string naming;                          ///< "px nx py ny pz nz"
};

/// The files that an environment's path stands for: with <FACE> in its name, one for each face; of
/// a folder, the one set of six there is in it. Nothing where the path is a file of its own.
///
/// Faces are called px nx py ny pz nz, posx negx posy negy posz negz, or, in the same order, right
/// left top bottom front back; capitals do not matter. In a folder that is how names end.
/// @error Fault::Input when faces are missing, by their names, or when there are several sets
std::optional<FaceFiles> face_files(const std::filesystem::path& path);

}  // namespace kiln
