// SPDX-License-Identifier: Apache-2.0
#include "kiln/io/texture_writer.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

#include "kiln/core/error.h"
#include "kiln/core/names.h"
#include "kiln/image/mip_levels.h"
#include "kiln/store/publish.h"
#include "level_encoder.h"

namespace kiln {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const std::string& reason) { throw Error(Fault::Usage, reason); }

void check(const WritableTexture& format, const TextureLayout& layout,
           const TextureWriteOptions& options) {
  if (std::find(format.types.begin(), format.types.end(), options.type) == format.types.end()) {
    std::vector<std::string_view> held;
    for (const PixelType one : format.types) held.push_back(pixel_type_name(one));
    refuse(fmt::format("{} cannot hold {}; it holds {}", format.name, pixel_type_name(options.type),
                       fmt::join(held, ", ")));
  }
  const bool container = format.name == "dds" || format.name == "ktx2";
  if (container && layout.names.size() > 4) {
    refuse(fmt::format("found channels {}; {} holds 1 to 4", fmt::join(layout.names, " "),
                       format.name));
  }
  if (options.supercompression != Supercompression::None || options.samples != Samples::Texels) {
    throw Error(Fault::Internal, "levels that grow side by side are plain texels");
  }
  const auto most = level_sizes(layout.size).size();
  if (area(layout.size) < 1 || layout.names.empty() || layout.levels < 1 ||
      static_cast<size_t>(layout.levels) > most) {
    throw Error(
        Fault::Internal,
        fmt::format("{} levels of {} x {} texels with {} layers cannot be written", layout.levels,
                    layout.size.width, layout.size.height, layout.names.size()));
  }
}

// What OpenImageIO's texture system looks for.
TextureWriteOptions described(std::string_view format, TextureWriteOptions options) {
  if (format != "openexr" && format != "tiff") return options;
  const auto add = [&](const char* name, const char* text) {
    const bool given = std::any_of(options.attributes.begin(), options.attributes.end(),
                                   [&](const auto& attribute) { return attribute.first == name; });
    if (!given) options.attributes.emplace_back(name, text);
  };
  add("textureformat", "Plain Texture");
  add("wrapmodes", "periodic,periodic");
  return options;
}

std::unique_ptr<io::LevelEncoder> make_encoder(std::string_view format,
                                               const io::TextureToWrite& texture) {
  if (format == "openexr") return io::openexr_levels(texture);
  if (format == "tiff") return io::tiff_levels(texture);
  return io::container_levels(format, texture);
}

}  // namespace

const std::vector<WritableTexture>& growing_textures() {
  using enum PixelType;
  static const std::vector<PixelType> all{Uint8, Uint16, Half, Float};
  static const std::vector<WritableTexture> formats{
      {.name = "openexr",
       .extension = ".exr",
       .types = {Half, Float},
       .shapes = "images",
       .holds_attributes = true},
      {.name = "tiff",
       .extension = ".tif",
       .types = all,
       .shapes = "images",
       .holds_attributes = true},
      {.name = "tiff",
       .extension = ".tx",
       .types = all,
       .shapes = "images",
       .holds_attributes = true},
      {.name = "dds", .extension = ".dds", .types = all, .shapes = "images"},
      {.name = "ktx2",
       .extension = ".ktx2",
       .types = all,
       .shapes = "images",
       .holds_attributes = true}};
  return formats;
}

const WritableTexture& growing_texture(const fs::path& path) {
  const std::string extension = kebab(path.extension().string());
  std::vector<std::string> known;
  for (const WritableTexture& format : growing_textures()) {
    if (format.extension == extension) return format;
    known.emplace_back(format.extension);
  }
  refuse(path.string() + ": " + unknown_name("file extension", extension, known));
}

struct TextureWriter::Unfinished {
  Unfinished(const fs::path& path_in, const TextureLayout& layout,
             const TextureWriteOptions& options)
      : path(path_in),
        sizes(level_sizes(layout.size, layout.levels)),
        names(layout.names),
        rows(sizes.size()),
        publication(path) {
    with_context(path.string(), [&] {
      const std::string_view format = growing_texture(path).name;
      encoder = make_encoder(format, {path, sizes, layout.names, described(format, options),
                                      publication.stream(), facts});
    });
  }

  // Rows of other levels or layers than promised.
  void check(int level, const Layers& band) const {
    const auto l = static_cast<size_t>(level);
    bool fits = level >= 0 && l < sizes.size() && band.size.width == sizes[l].width &&
                band.size.height <= sizes[l].height - rows[l] && band.layers.size() == names.size();
    for (size_t c = 0; fits && c < names.size(); ++c) {
      fits = band.layers[c].name == names[c] && band.layers[c].plane.size() == band.size;
    }
    if (!fits) throw Error(Fault::Internal, path.string() + ": rows that are not of the texture");
  }

  fs::path path;
  std::vector<Size> sizes;
  std::vector<std::string> names;
  std::vector<int> rows;  ///< of each level, written
  WriteFacts facts;
  Publication publication;
  std::unique_ptr<io::LevelEncoder> encoder;
};

TextureWriter::TextureWriter(const fs::path& path, const TextureLayout& layout,
                             const TextureWriteOptions& options) {
  with_context(path.string(), [&] { check(growing_texture(path), layout, options); });
  unfinished_ = std::make_unique<Unfinished>(path, layout, options);
}

TextureWriter::~TextureWriter() = default;

void TextureWriter::add(int level, const Layers& rows) {
  Unfinished& texture = *unfinished_;
  texture.check(level, rows);
  int& written = texture.rows[static_cast<size_t>(level)];
  with_context(texture.path.string(), [&] { texture.encoder->add(level, written, rows); });
  written += rows.size.height;
  texture.publication.stream().check();
}

WriteFacts TextureWriter::finish() {
  Unfinished& texture = *unfinished_;
  for (size_t l = 0; l < texture.sizes.size(); ++l) {
    if (texture.rows[l] != texture.sizes[l].height) {
      throw Error(Fault::Internal,
                  fmt::format("{}: {} of {} rows of level {}", texture.path.string(),
                              texture.rows[l], texture.sizes[l].height, l));
    }
  }
  with_context(texture.path.string(), [&] { texture.encoder->finish(); });
  texture.encoder.reset();
  texture.publication.put_in_place();
  return texture.facts;
}

}  // namespace kiln
