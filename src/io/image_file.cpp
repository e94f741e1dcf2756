// SPDX-License-Identifier: Apache-2.0
#include "kiln/io/image_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "file_bytes.h"
#include "kiln/core/error.h"
#include "kiln/core/names.h"
#include "kiln/store/publish.h"
#include "openexr_file.h"
#include "openimageio_file.h"
#include "radiance_hdr.h"
#include "samples.h"
#include "signature.h"

namespace kiln {
namespace {

namespace fs = std::filesystem;

std::string format_of(const fs::path& path) {
  return io::format_by_contents(path, io::first_bytes(path, io::signature_length));
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
io::StoredPlanes in_file_order(const Layers& image) {
  std::vector<const Layer*> layers;
  for (const Layer& layer : image.layers) layers.push_back(&layer);
  const auto rank = [](const Layer* layer) { return io::channel_rank(layer->name); };
  const bool all_known = std::all_of(layers.begin(), layers.end(), [&](const Layer* layer) {
    return rank(layer) <= io::channel_rank("A");
  });
  if (all_known) {
    std::stable_sort(layers.begin(), layers.end(),
                     [&](const Layer* a, const Layer* b) { return rank(a) < rank(b); });
  }
  io::StoredPlanes stored;
  for (const Layer* layer : layers) {
    if (layer->name == "A") stored.alpha_channel = static_cast<int>(stored.planes.size());
    stored.planes.push_back(&layer->plane);
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

// Formats of colour: two channels that are no grey with alpha get a third of zeros.
void complete_color(io::StoredPlanes& stored) {
  if (stored.planes.size() == 2 && stored.alpha_channel < 0) stored.planes.resize(3, nullptr);
}

io::StoredPlanes planes_for(const fs::path& path, const WritableFormat& format,
                            const Layers& image) {
  io::StoredPlanes stored = in_file_order(image);
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
  complete_color(stored);
  return stored;
}

std::string encoded(const WritableFormat& format, const Layers& image,
                    const io::StoredPlanes& stored, WriteOptions options, WriteFacts& facts) {
  if (format.name == "hdr") {
    std::vector<const Plane*> planes = stored.planes;
    std::erase(planes, nullptr);
    return io::encode_hdr(planes, facts);
  }
  if (format.name == "jpeg") options.attributes.clear();
  if (options.color_tag == ColorTag::Srgb) {
    options.attributes.emplace_back("oiio:ColorSpace", "sRGB");
  } else if (options.color_tag == ColorTag::Linear) {
    options.attributes.emplace_back("oiio:ColorSpace", "Linear");
  }
  return io::encode_by_openimageio(std::string(format.name), image.size, stored, options, facts);
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
  }
  return "float";
}

FileFacts inspect_image(const fs::path& path) {
  const std::string format = format_of(path);
  return with_context(path.string(), [&] {
    const ReadLimits limits;
    if (format == "openexr") return io::inspect_openexr(path, limits);
    const io::Bytes bytes = io::all_bytes(path);
    if (format == "hdr") return io::inspect_hdr(bytes, limits);
    return io::inspect_by_openimageio(format, bytes, limits);
  });
}

ImageFile read_image(const fs::path& path, const ReadLimits& limits) {
  const std::string format = format_of(path);
  return with_context(path.string(), [&] {
    if (format == "openexr") return io::read_openexr(path, limits);
    const io::Bytes bytes = io::all_bytes(path);
    if (format == "hdr") return io::read_hdr(bytes, limits);
    return io::read_by_openimageio(format, bytes, limits);
  });
}

const std::vector<WritableFormat>& writable_formats() {
  using enum PixelType;
  static const std::vector<WritableFormat> formats{
      {"openexr", {".exr"}, {Half, Float}, "any channels, by name"},
      {"hdr", {".hdr"}, {Float}, "R G B, or 1 or 2 channels; no alpha"},
      {"png", {".png"}, {Uint8, Uint16}, "1 to 4 channels; alpha A after one or three"},
      {"jpeg", {".jpg", ".jpeg"}, {Uint8}, "R G B, or 1 or 2 channels; no alpha"},
      {"tiff", {".tif", ".tiff"}, {Uint8, Uint16, Half, Float}, "any number of channels"}};
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
  const io::StoredPlanes stored = planes_for(path, format, image);
  publish_text(path, with_context(path.string(),
                                  [&] { return encoded(format, image, stored, options, facts); }));
  return facts;
}

}  // namespace kiln
