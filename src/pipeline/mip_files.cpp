// SPDX-License-Identifier: Apache-2.0
#include "mip_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <set>
#include <utility>

#include "kiln/image/mip_levels.h"
#include "kiln/io/image_file.h"
#include "kiln/io/texture_writer.h"
#include "kiln/parallel/rows.h"
#include "kiln/parallel/stages.h"
#include "kiln/pipeline/report.h"
#include "memory.h"

namespace kiln {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view srgb = "srgb_rec709_scene";

bool holds_levels(const fs::path& path) {
  const std::string extension = kebab(path.extension().string());
  const auto& formats = growing_textures();
  return std::any_of(formats.begin(), formats.end(),
                     [&](const auto& format) { return format.extension == extension; });
}

bool is_of_floats(const std::string& type) { return type == "half" || type == "float"; }

// What the bake was told to make, else by what the map holds.
std::string usual_extension(const MipSheet& sheet, const MipFile& file) {
  if (!sheet.extension.empty()) return sheet.extension;
  if (!sheet.file_per_level) return ".exr";
  return is_of_floats(file.preferred_type) ? ".exr" : ".png";
}

std::string file_name(const Task& task, const MipSheet& sheet, const MipFile& file) {
  return map_file_name(task, file.name, usual_extension(sheet, file),
                       names_an_image(task.out) || holds_levels(task.out), sheet.files.size());
}

void check_format(const MipSheet& sheet, const std::string& name) {
  const std::string extension = kebab(fs::path(name).extension().string());
  if (sheet.extension.empty() || sheet.extension == extension) return;
  throw Error(Fault::Usage, fmt::format("format: found {}, but the output is named '{}'",
                                        sheet.extension.substr(1), name));
}

std::string with_level(const std::string& name, int level) {
  const fs::path path(name);
  const std::string file =
      fmt::format("{}_{}{}", path.stem().string(), level, path.extension().string());
  return (path.parent_path() / file).generic_string();
}

bool is_integer(PixelType type) { return type == PixelType::Uint8 || type == PixelType::Uint16; }

/// A file of a sheet on its way: one texture, or an image per level.
struct File {
  std::vector<std::string> names;  ///< below the output folder
  PixelType type = PixelType::Half;
  std::string color_to;  ///< the space that it holds; empty: numbers
  std::unique_ptr<TextureWriter> texture;
  std::vector<std::unique_ptr<ImageWriter>> images;

  void add(int level, const Layers& rows) {
    if (texture) {
      texture->add(level, rows);
    } else {
      images[static_cast<size_t>(level)]->add(rows);
    }
  }
};

// Files of integers keep the encoding of the map, but where graphics libraries would not undo it:
// they know 8 bits of sRGB and no others.
std::string color_of(const MipFile& file, PixelType type, std::string_view format) {
  if (file.color_from.empty() || !is_integer(type)) return file.color_from;
  const bool sampled = format == "dds" || format == "ktx2";
  const bool decoded = type == PixelType::Uint8 && file.color_stored == srgb;
  return sampled && !decoded ? file.color_from : file.color_stored;
}

Attributes attributes_of(const MipFile& map, const File& file) {
  Attributes attributes = map.attributes;
  attributes.emplace_back("Software", software());
  attributes.emplace_back("colorInteropID", file.color_to.empty() ? "data" : file.color_to);
  return attributes;
}

ColorTag tag_of(const File& file) {
  return file.color_to == srgb ? ColorTag::Srgb : ColorTag::None;
}

void open_texture(const fs::path& path, const Task& task, const MipSheet& sheet, const MipFile& map,
                  File& file) {
  const WritableTexture& format = growing_texture(path);
  file.type = held_type(task, map.preferred_type, format.types);
  file.color_to = color_of(map, file.type, format.name);
  TextureWriteOptions options;
  options.type = file.type;
  options.color_tag = tag_of(file);
  if (format.holds_attributes) options.attributes = attributes_of(map, file);
  file.texture = std::make_unique<TextureWriter>(
      path, TextureLayout{sheet.size, sheet.levels, map.names}, options);
}

void open_images(const fs::path& folder, const Task& task, const MipSheet& sheet,
                 const MipFile& map, File& file) {
  const WritableFormat& format = writable_format(folder / file.names.front());
  file.type = held_type(task, map.preferred_type, format.types);
  file.color_to = color_of(map, file.type, format.name);
  WriteOptions options;
  options.run = for_rows;
  options.type = file.type;
  options.color_tag = tag_of(file);
  options.attributes = attributes_of(map, file);
  if (format.name == "png") options.packing = Packing::Fast;
  const std::vector<Size> sizes = level_sizes(sheet.size, sheet.levels);
  for (size_t l = 0; l < sizes.size(); ++l) {
    file.images.push_back(
        std::make_unique<ImageWriter>(folder / file.names[l], sizes[l], map.names, options));
  }
}

std::vector<File> open_files(const Plan& plan, const Task& task, const MipSheet& sheet) {
  std::vector<File> files;
  std::set<std::string> taken;
  for (const MipFile& map : sheet.files) {
    const std::string name = file_name(task, sheet, map);
    check_format(sheet, name);
    if (!taken.insert(name).second) {
      throw Error(Fault::Usage,
                  fmt::format("out: two files of {} would be named '{}'", task.bake, name));
    }
    File& file = files.emplace_back();
    if (!sheet.file_per_level && holds_levels(name)) {
      file.names = {name};
      open_texture(plan.output / name, task, sheet, map, file);
      continue;
    }
    for (int level = 0; level < sheet.levels; ++level)
      file.names.push_back(with_level(name, level));
    open_images(plan.output, task, sheet, map, file);
  }
  return files;
}

Written finish(std::vector<File>& files) {
  Written written;
  for (File& file : files) {
    for (size_t i = 0; i < file.names.size(); ++i) {
      const WriteFacts facts = file.texture ? file.texture->finish() : file.images[i]->finish();
      written.outputs.push_back(file.names[i]);
      const std::string note = clamping_note(file.names[i], file.type, facts);
      if (!note.empty()) written.notes.push_back(note);
    }
  }
  return written;
}

/// A band, from what is read to what is filtered.
struct Band {
  MapRows read;
  std::shared_ptr<void> rows;
};

}  // namespace

Written write_mips(const Plan& plan, const Task& task, const MipSheet& sheet, SetReader& reader,
                   const ColorConfig& config, const std::function<void()>& heed) {
  const BandPlan bands = require_bands(cost_of_rows(plan, task), plan.max_memory);
  std::vector<File> files = open_files(plan, task, sheet);
  const auto write = [&](Band& band) {
    std::vector<MipRows> made = sheet.filter(band.rows.get());
    band.rows.reset();
    for_rows(static_cast<int>(files.size()), [&](int i) {
      File& file = files[static_cast<size_t>(i)];
      const MipFile& map = sheet.files[static_cast<size_t>(i)];
      for (MipRows& rows : made) {
        if (rows.file != static_cast<size_t>(i)) continue;
        const std::string& from = rows.as_stored ? map.color_stored : map.color_from;
        if (from != file.color_to) config.convert(rows.image, from, file.color_to);
        file.add(rows.level, rows.image);
      }
    });
  };
  const int height = sheet.size.height;
  run_stages<Band>(
      (height + bands.rows - 1) / bands.rows, bands.at_once,
      [&](int i) {
        heed();
        return Band{reader.next(std::min(bands.rows, height - i * bands.rows)), nullptr};
      },
      [&](int, Band& band) {
        band.rows = sheet.read(band.read);
        band.read.windows.clear();
      },
      [&](int, Band& band) { write(band); });
  return finish(files);
}

}  // namespace kiln
