// SPDX-License-Identifier: Apache-2.0
#include "kiln/io/image_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

#include "file_bytes.h"
#include "kiln/core/error.h"
#include "kiln/core/names.h"
#include "kiln/store/publish.h"
#include "npy_read.h"
#include "openexr_file.h"
#include "openimageio_file.h"
#include "radiance_hdr.h"
#include "samples.h"
#include "signature.h"
#include "table_files.h"
#include "texel_pack.h"
#include "texture_files.h"
#include "volume_file.h"

namespace kiln {
namespace {

namespace fs = std::filesystem;

std::string format_of(const fs::path& path) {
  return io::format_by_contents(path, io::first_bytes(path, io::signature_length));
}

// Where the texels of a texture container lie; nothing where OpenImageIO is to read the file.
std::optional<io::StoredTexels> texels_of(const std::string& format, io::ByteView bytes) {
  if (format == "dds") return io::dds_texels(bytes);
  if (format == "ktx") return io::ktx1_texels(bytes);
  if (format == "ktx2") return io::ktx2_texels(bytes);
  return std::nullopt;
}

void check_type(const fs::path& path, const WritableFormat& format, PixelType type) {
  if (std::find(format.types.begin(), format.types.end(), type) != format.types.end()) return;
  std::vector<std::string_view> held;
  for (const PixelType one : format.types) held.push_back(pixel_type_name(one));
  throw Error(Fault::Usage, fmt::format("{}: {} cannot hold {}; it holds {}", path.string(),
                                        format.name, pixel_type_name(type), fmt::join(held, ", ")));
}

void check_planes(const fs::path& path, const Layers& image) {
  const bool whole = std::all_of(image.layers.begin(), image.layers.end(), [&](const Layer& layer) {
    return layer.plane.size() == image.size;
  });
  if (!whole || image.layers.empty() || area(image.size) < 1) {
    throw Error(Fault::Internal, fmt::format("{}: an image of {} x {} texels with {} planes cannot "
                                             "be written",
                                             path.string(), image.size.width, image.size.height,
                                             image.layers.size()));
  }
}

// R G B A (or Y A) in that order where all names are of these, else as the layers stand.
io::StoredPlanes in_file_order(const Layers& image, const Labels& labels) {
  std::vector<size_t> order(image.layers.size());
  std::iota(order.begin(), order.end(), size_t{0});
  const auto rank = [&](size_t at) { return io::channel_rank(image.layers[at].name); };
  const bool all_known = std::all_of(order.begin(), order.end(),
                                     [&](size_t at) { return rank(at) <= io::channel_rank("A"); });
  if (all_known) {
    std::stable_sort(order.begin(), order.end(),
                     [&](size_t a, size_t b) { return rank(a) < rank(b); });
  }
  const bool labelled = labels.channels.size() == order.size();
  io::StoredPlanes stored;
  stored.planes.reserve(order.size());
  stored.names.reserve(order.size());
  for (const size_t at : order) {
    const Layer& layer = image.layers[at];
    if (layer.name == "A") stored.alpha_channel = static_cast<int>(stored.planes.size());
    stored.planes.push_back(&layer.plane);
    stored.names.push_back(labelled ? labels.channels[at] : layer.name);
  }
  return stored;
}

[[noreturn]] void refuse_channels(const fs::path& path, const WritableFormat& format,
                                  const Layers& image) {
  std::vector<std::string_view> found;
  for (const Layer& layer : image.layers) found.push_back(layer.name);
  throw Error(Fault::Usage, fmt::format("{}: found channels {}; {} holds {}", path.string(),
                                        fmt::join(found, " "), format.name, format.channels));
}

bool holds_tables(const WritableFormat& format) {
  constexpr std::array names{"dds", "ktx2", "npy", "csv", "h"};
  return std::count(names.begin(), names.end(), format.name) > 0;
}

// The number of channels is all that limits textures, and files of tables hold any.
io::StoredPlanes planes_of_table(const fs::path& path, const WritableFormat& format,
                                 const Layers& image, const WriteOptions& options) {
  io::StoredPlanes stored = in_file_order(image, options.labels);
  const bool texture = format.name == "dds" || format.name == "ktx2";
  if (texture && stored.planes.size() > 4) refuse_channels(path, format, image);
  return stored;
}

io::StoredPlanes planes_of_picture(const fs::path& path, const WritableFormat& format,
                                   const Layers& image, const WriteOptions& options) {
  io::StoredPlanes stored = in_file_order(image, options.labels);
  if (format.name == "tiff") return stored;
  const bool holds_alpha = format.name == "png";
  const size_t most = holds_alpha ? 4 : 3;
  const bool alpha_misplaced = stored.alpha_channel >= 0 &&
                               stored.alpha_channel + 1 != static_cast<int>(stored.planes.size());
  if (stored.planes.size() > most || (stored.alpha_channel >= 0 && !holds_alpha) ||
      alpha_misplaced || (stored.alpha_channel == 2)) {
    refuse_channels(path, format, image);
  }
  if (stored.planes.size() == 4) stored.alpha_channel = 3;
  if (stored.planes.size() == 1) stored.alpha_channel = -1;
  // Formats of colour: two channels that are no grey with alpha get a third of zeros.
  if (stored.planes.size() == 2 && stored.alpha_channel < 0) stored.planes.resize(3, nullptr);
  return stored;
}

void check_rgbd(const fs::path& path, const io::StoredPlanes& stored, PixelType type) {
  if (type != PixelType::Rgbd8 || (stored.planes.size() <= 3 && stored.alpha_channel < 0)) return;
  throw Error(Fault::Usage, fmt::format("{}: found {} channels; rgbd8 holds 1 to 3, its alpha is a "
                                        "divisor of theirs",
                                        path.string(), stored.planes.size()));
}

std::string encoded_picture(const WritableFormat& format, Size size, const io::StoredPlanes& stored,
                            WriteOptions options, WriteFacts& facts) {
  if (format.name == "hdr") {
    std::vector<const Plane*> planes = stored.planes;
    std::erase(planes, nullptr);
    return io::encode_hdr(planes, options.attributes, facts);
  }
  if (options.type == PixelType::Rgbd8) {
    const Layers coded = io::rgbd_image(size, stored, facts);
    options.type = PixelType::Uint8;
    return encoded_picture(format, size, io::planes_of(coded), std::move(options), facts);
  }
  if (format.name == "jpeg") options.attributes.clear();
  if (options.color_tag == ColorTag::Srgb) {
    options.attributes.emplace_back("oiio:ColorSpace", "sRGB");
  } else if (options.color_tag == ColorTag::Linear) {
    options.attributes.emplace_back("oiio:ColorSpace", "Linear");
  }
  return io::encode_by_openimageio(std::string(format.name), size, stored, options, facts);
}

std::string encoded(const fs::path& path, const WritableFormat& format, const Layers& image,
                    const WriteOptions& options, WriteFacts& facts) {
  const bool table = holds_tables(format);
  const io::StoredPlanes stored = table ? planes_of_table(path, format, image, options)
                                        : planes_of_picture(path, format, image, options);
  check_rgbd(path, stored, options.type);
  return with_context(path.string(), [&] {
    if (table) return io::encode_table(format.name, path, stored, options, facts);
    return encoded_picture(format, image.size, stored, options, facts);
  });
}

WriteFacts write_openexr_file(const fs::path& path, const Layers& image,
                              const WriteOptions& options) {
  WriteFacts facts;
  publish_file(path, [&](const fs::path& temporary) {
    facts = io::write_openexr(temporary, path, image, options);
  });
  return facts;
}

}  // namespace

std::string_view pixel_type_name(PixelType type) {
  switch (type) {
    case PixelType::Uint8:
      return "uint8";
    case PixelType::Uint16:
      return "uint16";
    case PixelType::Half:
      return "half";
    case PixelType::Float:
      return "float";
    case PixelType::Rgb10a2:
      return "rgb10a2";
    case PixelType::Rgbd8:
      return "rgbd8";
  }
  return "float";
}

FileFacts inspect_image(const fs::path& path) {
  const std::string format = format_of(path);
  return with_context(path.string(), [&] {
    const ReadLimits limits;
    if (format == "openexr") return io::inspect_openexr(path, limits);
    const io::FileContents contents(path);
    const io::ByteView bytes = contents.view();
    if (format == "hdr") return io::inspect_hdr(bytes, limits);
    if (format == "npy") return io::inspect_npy(bytes, limits);
    if (const auto texels = texels_of(format, bytes)) {
      return io::facts_of_texels(*texels, bytes, limits);
    }
    return io::inspect_by_openimageio(format, bytes, limits);
  });
}

ImageFile read_image(const fs::path& path, const ReadLimits& limits,
                     const std::vector<std::string>& channels) {
  const std::string format = format_of(path);
  return with_context(path.string(), [&] {
    const io::Reading reading{.limits = limits, .channels = channels};
    ImageFile file = io::read_volume(path, format, reading).file;
    std::erase_if(file.image.layers,
                  [&](const Layer& layer) { return !reading.wants(layer.name); });
    return file;
  });
}

io::Volume io::read_volume(const fs::path& path, const std::string& format,
                           const Reading& reading) {
  if (format == "openexr") return {read_openexr(path, reading)};
  const FileContents contents(path);
  const ByteView bytes = contents.view();
  Reading in_pieces = reading;
  in_pieces.let_go = [&] { contents.let_go(); };
  if (format == "hdr") return {read_hdr(bytes, in_pieces)};
  if (format == "npy") return read_npy_image(bytes, reading.limits);
  if (const auto texels = texels_of(format, bytes)) {
    return read_texels(*texels, bytes, reading.limits);
  }
  return {read_by_openimageio(format, bytes, in_pieces)};
}

const std::vector<WritableFormat>& writable_formats() {
  using enum PixelType;
  static const std::vector<WritableFormat> formats{
      {"openexr", {".exr"}, {Half, Float}, "any channels, by name", true},
      {"hdr", {".hdr"}, {Float}, "R G B, or 1 or 2 channels; no alpha", true},
      {"png",
       {".png"},
       {Uint8, Rgbd8, Uint16},
       "1 to 4 channels; alpha A after one or three",
       true},
      {"jpeg", {".jpg", ".jpeg"}, {Uint8}, "R G B, or 1 or 2 channels; no alpha", false},
      {"tiff", {".tif", ".tiff"}, {Uint8, Uint16, Half, Float}, "any number of channels", true},
      {"dds", {".dds"}, {Half, Uint8, Uint16, Rgb10a2, Rgbd8, Float}, "1 to 4 channels", false},
      {"ktx2", {".ktx2"}, {Half, Uint8, Uint16, Rgb10a2, Rgbd8, Float}, "1 to 4 channels", true},
      {"npy", {".npy"}, {Half, Uint8, Uint16, Float}, "any number of channels", false},
      {"csv", {".csv"}, {Float}, "any channels, by name", true},
      {"h", {".h"}, {Half, Uint8, Uint16, Float}, "any number of channels", true}};
  return formats;
}

const WritableFormat& writable_format(const fs::path& path) {
  const std::string extension = kebab(path.extension().string());
  std::vector<std::string> known;
  for (const WritableFormat& format : writable_formats()) {
    for (const std::string_view one : format.extensions) {
      if (one == extension) return format;
      known.emplace_back(one);
    }
  }
  throw Error(Fault::Usage,
              path.string() + ": " + unknown_name("file extension", extension, known));
}

WriteFacts write_image(const fs::path& path, const Layers& image, const WriteOptions& options) {
  const WritableFormat& format = writable_format(path);
  check_type(path, format, options.type);
  check_planes(path, image);
  if (format.name == "openexr") return write_openexr_file(path, image, options);
  WriteFacts facts;
  publish_text(path, encoded(path, format, image, options, facts));
  return facts;
}

}  // namespace kiln
