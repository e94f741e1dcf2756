// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "kiln/core/error.h"
#include "samples.h"
#include "texture_files.h"

namespace kiln::io {
namespace {

[[noreturn]] void refuse(const std::string& reason) { throw Error(Fault::Input, reason); }

std::vector<StoredLevel> levels_of(const StoredTexels& stored, ByteView bytes) {
  if (stored.format == "dds") return dds_levels(stored);
  return stored.format == "ktx" ? ktx1_levels(stored, bytes) : ktx2_levels(stored, bytes);
}

void check_shape(const StoredTexels& stored) {
  if (stored.depth > 1) {
    refuse(fmt::format("a volume of {} slices, expected a texture of images", stored.depth));
  }
  if (stored.faces != 1 && stored.faces != 6) {
    refuse(fmt::format("a cube of {} faces, expected all six", stored.faces));
  }
  if (stored.faces == 6 && stored.width != stored.height) {
    refuse(fmt::format("a cube with faces of {} x {} texels, expected squares", stored.width,
                       stored.height));
  }
}

// What is said of one level that is taken for the whole.
StoredTexels at_level(const StoredTexels& stored, const StoredLevel& level) {
  StoredTexels one = stored;
  one.width = level.width;
  one.height = level.height;
  one.row_pitch = level.row_pitch;
  one.first = level.first;
  one.stored_bytes = level.stored_bytes;
  return one;
}

std::vector<Layers> read_level(const StoredTexels& stored, const StoredLevel& level, ByteView bytes,
                               const ReadLimits& limits) {
  StoredTexels one = at_level(stored, level);
  Bytes inflated;
  if (one.supercompression != Supercompression::None) {
    inflated = inflated_level(one, bytes, limits);
    bytes = inflated;
    one.first = 0;
    one.supercompression = Supercompression::None;
  }
  const size_t first = one.first;
  std::vector<Layers> faces;
  for (size_t face = 0; face < static_cast<size_t>(stored.faces); ++face) {
    if (level.face_step > bytes.size()) refuse("truncated: a face is larger than the file");
    one.first = first + face * level.face_step;
    faces.push_back(read_texels(one, bytes, limits).file.image);
  }
  return faces;
}

}  // namespace

std::vector<StoredLevel> empty_levels(const StoredTexels& stored) {
  std::vector<StoredLevel> levels(static_cast<size_t>(stored.levels));
  for (size_t l = 0; l < levels.size(); ++l) {
    levels[l].width = std::max(1LL, stored.width >> l);
    levels[l].height = std::max(1LL, stored.height >> l);
  }
  return levels;
}

std::optional<StoredTexels> stored_texels(const std::string& format, ByteView bytes) {
  if (format == "dds") return dds_texels(bytes);
  if (format == "ktx") return ktx1_texels(bytes);
  if (format == "ktx2") return ktx2_texels(bytes);
  return std::nullopt;
}

TextureFile read_stored_texture(const StoredTexels& stored, ByteView bytes,
                                const ReadLimits& limits) {
  check_shape(stored);
  require_levels_within(limits, stored.width, stored.height, stored.levels, stored.faces);
  StoredTexels one_face = stored;  // of which no note says that others are left
  one_face.faces = 1;
  one_face.levels = 1;
  TextureFile file;
  file.facts = facts_of_texels(one_face, bytes, limits);
  for (const StoredLevel& level : levels_of(stored, bytes)) {
    file.texture.levels.push_back(read_level(stored, level, bytes, limits));
  }
  file.stored = coded_as(stored.texel.coding);
  file.supercompression = stored.supercompression;
  return file;
}

}  // namespace kiln::io
