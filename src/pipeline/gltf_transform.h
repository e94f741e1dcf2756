// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <vector>

#include "json_at.h"
#include "kiln/image/wrap.h"

namespace kiln {

/// How a use of a texture places it on the mesh.
struct TexturePlacing {
  size_t coordinates = 0;  ///< number of the set of texture coordinates
  std::array<float, 2> offset{0, 0}, scale{1, 1};
  double rotation = 0;  ///< [rad], as KHR_texture_transform counts it

  bool operator==(const TexturePlacing&) const = default;
};

/// With KHR_texture_transform where the use has it. Whole tiles of a texture that repeats move
/// nothing, and are left out of the offset.
TexturePlacing placing_of(const JsonAt& use, Wrap wrap);

/// The uses of textures in a material, by where their texels go on the mesh.
///
/// Maps are read texel by texel, whatever coordinates put them on a mesh. Where those are the same
/// for all, that is exact: the mesh places what is baked as it placed what was read.
class TexturePlacings {
 public:
  void add(const std::string& use, const TexturePlacing& placing);
  /// What is lost where they differ, naming each; empty where they do not.
  std::string difference() const;
  /// The transform that all have in common; empty where that is none.
  std::string common() const;

 private:
  struct Group {
    TexturePlacing placing;
    std::string uses;  ///< "normalTexture, occlusionTexture"
  };
  std::vector<Group> groups_;
};

}  // namespace kiln
