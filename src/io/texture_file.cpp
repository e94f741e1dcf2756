// SPDX-License-Identifier: Apache-2.0
#include "kiln/io/texture_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

#include "container_write.h"
#include "env_file.h"
#include "file_bytes.h"
#include "kiln/core/error.h"
#include "kiln/core/names.h"
#include "kiln/store/publish.h"
#include "openexr_texture.h"
#include "signature.h"
#include "stored_planes.h"
#include "texel_pack.h"
#include "texture_files.h"
#include "volume_file.h"

namespace kiln {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const std::string& reason) { throw Error(Fault::Usage, reason); }

bool same_layers(const Layers& a, const Layers& b) {
  return std::equal(a.layers.begin(), a.layers.end(), b.layers.begin(), b.layers.end(),
                    [](const Layer& one, const Layer& other) { return one.name == other.name; });
}

bool is_whole(const Layers& face, Size size, const Layers& first) {
  return face.size == size && same_layers(face, first) &&
         std::all_of(face.layers.begin(), face.layers.end(),
                     [&](const Layer& layer) { return layer.plane.size() == size; });
}

// What Texture promises.
void check_texture(const Texture& texture) {
  bool whole = !texture.levels.empty() && !texture.levels.front().empty();
  const size_t faces = whole ? texture.levels.front().size() : 0;
  whole = whole && (faces == 1 || faces == 6) && !texture.levels[0][0].layers.empty();
  Size size = whole ? texture.levels[0][0].size : Size{};
  whole = whole && area(size) > 0 && (faces == 1 || size.width == size.height);
  for (size_t l = 0; whole && l < texture.levels.size(); ++l) {
    const std::vector<Layers>& level = texture.levels[l];
    whole = level.size() == faces && (l == 0 || area(texture.levels[l - 1][0].size) > 1) &&
            std::all_of(level.begin(), level.end(), [&](const Layers& face) {
              return is_whole(face, size, texture.levels[0][0]);
            });
    size = {std::max(1, size.width / 2), std::max(1, size.height / 2)};
  }
  if (!whole) {
    throw Error(Fault::Internal, "levels and faces that are no texture cannot be written");
  }
}

void check_type(const WritableTexture& format, PixelType type) {
  if (std::find(format.types.begin(), format.types.end(), type) != format.types.end()) return;
  std::vector<std::string_view> held;
  for (const PixelType one : format.types) held.push_back(pixel_type_name(one));
  refuse(fmt::format("{} cannot hold {}; it holds {}", format.name, pixel_type_name(type),
                     fmt::join(held, ", ")));
}

void check_options(const WritableTexture& format, const TextureWriteOptions& options) {
  check_type(format, options.type);
  if (options.supercompression != Supercompression::None && !format.supercompresses) {
    refuse(fmt::format("{} has no supercompression; ktx2 has zstd", format.name));
  }
  if (options.samples == Samples::Nodes && format.name != "openexr") {
    refuse(fmt::format("{} holds samples at texel centres, these are at nodes; openexr holds both",
                       format.name));
  }
}

// Babylon.js wants 2^n texels and every level.
void check_env(const Texture& texture) {
  const int edge = texture.levels.front().front().size.width;
  const bool power = (edge & (edge - 1)) == 0;
  const bool complete = texture.levels.back().front().size.width == 1;
  if (power && complete) return;
  refuse(
      fmt::format("found {} levels from {} texels; env holds cubes of 2^n texels with all levels "
                  "down to 1",
                  texture.levels.size(), edge));
}

void check_contents(const WritableTexture& format, const Texture& texture, PixelType type) {
  if (!texture.is_cube() && !format.holds_images) {
    refuse(fmt::format("found an image; {} holds {}", format.name, format.shapes));
  }
  if (format.name == "env") check_env(texture);
  const Layers& first = texture.levels.front().front();
  io::require_room(io::in_file_order(first), type);
  if (format.name == "openexr" || first.layers.size() <= 4) return;
  std::vector<std::string_view> found;
  for (const Layer& layer : first.layers) found.push_back(layer.name);
  refuse(fmt::format("found channels {}; {} holds 1 to 4", fmt::join(found, " "), format.name));
}

void write_format(const fs::path& path, const Texture& texture, const TextureWriteOptions& options,
                  ByteStream& out, WriteFacts& facts) {
  const std::string_view format = writable_texture(path).name;
  if (format == "openexr") return io::write_openexr_texture(texture, options, out, facts);
  if (format == "env") return io::write_env(path, texture, options, out, facts);
  io::write_container(format, texture, options, out, facts);
}

// Of an image that is no texture container: the one level that it is.
TextureFile texture_of(io::Volume volume) {
  if (volume.depth > 1) {
    throw Error(Fault::Input,
                fmt::format("a volume of {} slices, expected a texture of images", volume.depth));
  }
  TextureFile file;
  file.stored = volume.file.facts.type;
  file.facts = std::move(volume.file.facts);
  file.texture.levels.emplace_back().push_back(std::move(volume.file.image));
  return file;
}

TextureFile read_format(const fs::path& path, const std::string& format, const ReadLimits& limits) {
  if (format == "openexr") return io::read_openexr_texture(path, limits);
  if (format == "env") return io::read_env_texture(io::all_bytes(path), limits);
  if (format == "dds" || format == "ktx" || format == "ktx2") {
    const io::Bytes bytes = io::all_bytes(path);
    if (const auto stored = io::stored_texels(format, bytes)) {
      return io::read_stored_texture(*stored, bytes, limits);
    }
  }
  return texture_of(io::read_volume(path, format, limits));
}

}  // namespace

const std::vector<WritableTexture>& writable_textures() {
  using enum PixelType;
  static const std::vector<PixelType> packed_too{Half, Float, B10g11r11, E5b9g9r9};
  static const std::vector<WritableTexture> formats{
      {.name = "ktx2",
       .extension = ".ktx2",
       .types = packed_too,
       .shapes = "cubes and images",
       .holds_attributes = true,
       .supercompresses = true},
      {.name = "ktx",
       .extension = ".ktx",
       .types = packed_too,
       .shapes = "cubes and images",
       .holds_attributes = true},
      {.name = "dds", .extension = ".dds", .types = packed_too, .shapes = "cubes and images"},
      {.name = "openexr",
       .extension = ".exr",
       .types = {Half, Float},
       .shapes = "images, lat-longs and cubes with samples at nodes",
       .holds_attributes = true},
      {.name = "env",
       .extension = ".env",
       .types = {Rgbd8},
       .shapes = "cubes of 2^n texels with all levels",
       .holds_images = false,
       .holds_attributes = true}};
  return formats;
}

const WritableTexture& writable_texture(const fs::path& path) {
  const std::string extension = kebab(path.extension().string());
  std::vector<std::string> known;
  for (const WritableTexture& format : writable_textures()) {
    if (format.extension == extension) return format;
    known.emplace_back(format.extension);
  }
  throw Error(Fault::Usage,
              path.string() + ": " + unknown_name("file extension", extension, known));
}

WriteFacts write_texture(const fs::path& path, const Texture& texture,
                         const TextureWriteOptions& options) {
  const WritableTexture& format = writable_texture(path);
  with_context(path.string(), [&] {
    check_options(format, options);
    check_texture(texture);
    check_contents(format, texture, options.type);
  });
  WriteFacts facts;
  publish_stream(path, [&](ByteStream& out) {
    with_context(path.string(), [&] { write_format(path, texture, options, out, facts); });
  });
  return facts;
}

TextureFile read_texture(const fs::path& path, const ReadLimits& limits) {
  const std::string format =
      io::format_by_contents(path, io::first_bytes(path, io::signature_length));
  return with_context(path.string(), [&] { return read_format(path, format, limits); });
}

}  // namespace kiln
