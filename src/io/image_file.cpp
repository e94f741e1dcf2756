// SPDX-License-Identifier: Apache-2.0
#include "kiln/io/image_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <functional>
#include <memory>
#include <utility>

#include "band_encoder.h"
#include "env_file.h"
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

constexpr const char* openexr_in_memory =
    "OpenEXR images are read from files of their own, not from within others";

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

[[noreturn]] void refuse_image(const fs::path& path, Size size, size_t planes) {
  throw Error(Fault::Internal,
              fmt::format("{}: an image of {} x {} texels with {} planes cannot be written",
                          path.string(), size.width, size.height, planes));
}

std::vector<std::string> names_of(const Layers& image) {
  std::vector<std::string> names;
  for (const Layer& layer : image.layers) names.push_back(layer.name);
  return names;
}

void check_planes(const fs::path& path, const Layers& image) {
  const bool whole = std::all_of(image.layers.begin(), image.layers.end(), [&](const Layer& layer) {
    return layer.plane.size() == image.size;
  });
  if (!whole || image.layers.empty() || area(image.size) < 1) {
    refuse_image(path, image.size, image.layers.size());
  }
}

void check_bands(const fs::path& path, const ImageBands& image) {
  if (area(image.size) < 1 || image.names.empty() || image.band_rows < 1) {
    refuse_image(path, image.size, image.names.size());
  }
}

// A band of other rows or layers than promised.
void check_band(const fs::path& path, const Layers& band, Size size,
                const std::vector<std::string>& names) {
  check_planes(path, band);
  if (band.size != size || names_of(band) != names) refuse_image(path, band.size, names.size());
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
  io::StoredPlanes stored = io::in_file_order(image, options.labels.channels);
  const bool texture = format.name == "dds" || format.name == "ktx2";
  if (texture && stored.planes.size() > 4) refuse_channels(path, format, image);
  return stored;
}

io::StoredPlanes planes_of_picture(const fs::path& path, const WritableFormat& format,
                                   const Layers& image, const WriteOptions& options) {
  io::StoredPlanes stored = io::in_file_order(image, options.labels.channels);
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

io::StoredPlanes planes_of_format(const fs::path& path, const WritableFormat& format,
                                  const Layers& image, const WriteOptions& options) {
  if (format.name == "openexr") return io::in_file_order(image);
  return holds_tables(format) ? planes_of_table(path, format, image, options)
                              : planes_of_picture(path, format, image, options);
}

// Colour over a common divisor is an image of bytes to the format.
class RgbdEncoder : public io::BandEncoder {
 public:
  RgbdEncoder(std::unique_ptr<io::BandEncoder> bytes, WriteFacts& facts)
      : bytes_(std::move(bytes)), facts_(facts) {}

  void add(const io::StoredPlanes& band) override {
    const Layers coded = io::rgbd_image(band.size(), band, facts_);
    bytes_->add(io::planes_of(coded));
  }
  void finish() override { bytes_->finish(); }

 private:
  std::unique_ptr<io::BandEncoder> bytes_;
  WriteFacts& facts_;
};

std::unique_ptr<io::BandEncoder> make_encoder(io::FileToWrite file,
                                              const io::StoredPlanes& layout) {
  if (file.options.type == PixelType::Rgbd8) {
    file.options.type = PixelType::Uint8;
    file.options.labels = {};
    const Layers coded = make_layers({}, {"R", "G", "B", "A"});
    return std::make_unique<RgbdEncoder>(make_encoder(file, io::planes_of(coded)), file.facts);
  }
  if (file.format == "openexr") return io::openexr_encoder(file, layout);
  if (file.format == "hdr") return io::hdr_encoder(file);
  if (holds_tables(writable_format(file.path))) return io::table_encoder(file, layout);
  return io::openimageio_encoder(file, layout);
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
    case PixelType::B10g11r11:
      return "b10g11r11";
    case PixelType::E5b9g9r9:
      return "e5b9g9r9";
  }
  return "float";
}

FileFacts inspect_image(const fs::path& path) {
  const std::string format = format_of(path);
  return with_context(path.string(), [&] {
    const ReadLimits limits;
    if (format == "openexr") return io::inspect_openexr(path, limits);
    const io::FileContents contents(path);
    return io::facts_of_bytes(contents.view(), format, limits);
  });
}

FileFacts io::facts_of_bytes(ByteView bytes, const std::string& format, const ReadLimits& limits) {
  if (format == "openexr") throw Error(Fault::Input, openexr_in_memory);
  if (format == "hdr") return inspect_hdr(bytes, limits);
  if (format == "npy") return inspect_npy(bytes, limits);
  if (format == "env") return inspect_env(bytes, limits);
  if (const auto texels = stored_texels(format, bytes)) {
    return facts_of_texels(*texels, bytes, limits);
  }
  return inspect_by_openimageio(format, bytes, limits);
}

ImageFile read_image(const fs::path& path, const ReadLimits& limits,
                     const std::vector<std::string>& channels, const RunTasks& run) {
  const std::string format = format_of(path);
  return with_context(path.string(), [&] {
    const io::Reading reading{.limits = limits, .channels = channels, .run = run};
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
  return volume_of_bytes(contents.view(), format, in_pieces(reading, contents));
}

io::Volume io::volume_of_bytes(ByteView bytes, const std::string& format, const Reading& reading) {
  if (format == "openexr") throw Error(Fault::Input, openexr_in_memory);
  if (format == "hdr") return {read_hdr(bytes, reading)};
  if (format == "npy") return read_npy_image(bytes, reading.limits);
  if (format == "env") return {read_env(bytes, reading.limits)};
  if (const auto texels = stored_texels(format, bytes)) {
    return read_texels(*texels, bytes, reading.limits);
  }
  return {read_by_openimageio(format, bytes, reading)};
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

struct ImageWriter::Unfinished {
  Unfinished(fs::path path_in, Size size, const std::vector<std::string>& names,
             WriteOptions options_in)
      : path(std::move(path_in)),
        format(writable_format(path)),
        options(std::move(options_in)),
        publication(path) {
    const Layers blank = make_layers({}, names);
    const io::StoredPlanes layout = planes(blank);
    with_context(path.string(), [&] {
      encoder =
          make_encoder({path, format.name, size, options, publication.stream(), facts}, layout);
    });
  }

  io::StoredPlanes planes(const Layers& image) const {
    return planes_of_format(path, format, image, options);
  }

  fs::path path;
  const WritableFormat& format;
  WriteOptions options;
  WriteFacts facts;
  Publication publication;
  std::unique_ptr<io::BandEncoder> encoder;
};

ImageWriter::ImageWriter(const fs::path& path, Size size, const std::vector<std::string>& names,
                         const WriteOptions& options) {
  const WritableFormat& format = writable_format(path);
  check_type(path, format, options.type);
  const Layers blank = make_layers({}, names);
  const io::StoredPlanes layout = planes_of_format(path, format, blank, options);
  with_context(path.string(), [&] { io::require_room(layout, options.type); });
  unfinished_ = std::make_unique<Unfinished>(path, size, names, options);
}

ImageWriter::~ImageWriter() = default;

void ImageWriter::add(const Layers& band) {
  with_context(unfinished_->path.string(),
               [&] { unfinished_->encoder->add(unfinished_->planes(band)); });
  unfinished_->publication.stream().check();
}

WriteFacts ImageWriter::finish() {
  with_context(unfinished_->path.string(), [&] { unfinished_->encoder->finish(); });
  unfinished_->publication.put_in_place();
  return unfinished_->facts;
}

WriteFacts write_image(const fs::path& path, const Layers& image, const WriteOptions& options) {
  check_planes(path, image);
  ImageWriter writer(path, image.size, names_of(image), options);
  writer.add(image);
  return writer.finish();
}

WriteFacts write_bands(const fs::path& path, const ImageBands& image, const WriteOptions& options) {
  check_bands(path, image);
  ImageWriter writer(path, image.size, image.names, options);
  for (int first = 0; first < image.size.height; first += image.band_rows) {
    const int rows = std::min(image.band_rows, image.size.height - first);
    const Layers band = image.make(first, rows);
    check_band(path, band, {image.size.width, rows}, image.names);
    writer.add(band);
  }
  return writer.finish();
}

}  // namespace kiln
