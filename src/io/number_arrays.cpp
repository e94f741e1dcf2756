// SPDX-License-Identifier: Apache-2.0
#include "kiln/io/number_arrays.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "kiln/core/error.h"
#include "kiln/core/names.h"
#include "npy_read.h"
#include "number_text.h"
#include "openimageio_file.h"
#include "signature.h"
#include "volume_file.h"

namespace kiln {
namespace {

namespace fs = std::filesystem;

constexpr size_t least_numbers = 16;

NumberArray::Stored stored_as(PixelType type) {
  using enum NumberArray::Stored;
  switch (type) {
    case PixelType::Uint8:
    case PixelType::Rgbd8:
      return Uint8;
    case PixelType::Uint16:
      return Uint16;
    case PixelType::Half:
    case PixelType::B10g11r11:
      return Half;
    case PixelType::Float:
    case PixelType::E5b9g9r9:
      return Float;
    case PixelType::Rgb10a2:
      return Rgb10a2;
  }
  return Float;
}

NumberArray array_of(io::Volume volume) {
  const Layers& image = volume.file.image;
  FileFacts& facts = volume.file.facts;
  NumberArray array;
  if (volume.depth > 1) array.shape.push_back(volume.depth);
  for (const int length : {image.size.height / volume.depth, image.size.width,
                           static_cast<int>(image.layers.size())}) {
    array.shape.push_back(length);
  }
  array.stored = stored_as(facts.type);
  array.channels = std::move(facts.channels);
  array.attributes = std::move(facts.attributes);
  array.notes = std::move(facts.notes);
  array.values.reserve(static_cast<size_t>(area(image.size)) * image.layers.size());
  for (int y = 0; y < image.size.height; ++y) {
    for (int x = 0; x < image.size.width; ++x) {
      for (const Layer& layer : image.layers) array.values.push_back(layer.plane.at(x, y));
    }
  }
  return array;
}

bool is_text(io::ByteView bytes) { return std::find(bytes.begin(), bytes.end(), 0) == bytes.end(); }

// Two letters are all that opens a BMP or a PNM, and a header line of a table may begin with them.
bool is_named_text(const fs::path& path, const std::string& format, io::ByteView bytes) {
  constexpr std::array names{".csv", ".tsv", ".txt", ".dat", ".h", ".hpp", ".inc", ".js", ".json"};
  const std::string extension = kebab(path.extension().string());
  const bool short_mark = format == "bmp" || format == "pnm";
  return short_mark && std::count(names.begin(), names.end(), extension) > 0 && is_text(bytes);
}

std::vector<NumberArray> arrays_of_text(io::ByteView bytes, const ReadLimits& limits) {
  if (!is_text(bytes)) {
    throw Error(Fault::Input,
                "neither an image, .npy nor text; expected one of these with a table of numbers");
  }
  std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
  if (auto table = io::read_number_table(text)) return {std::move(*table)};
  io::ScriptArrays found = io::read_script_arrays(text, least_numbers);
  for (const io::ScriptArrays::Encoded& image : found.images) {
    const auto* png = reinterpret_cast<const uint8_t*>(image.png.data());
    NumberArray array = array_of({io::read_by_openimageio("png", {png, image.png.size()}, limits)});
    if (array.values.size() < least_numbers) continue;
    array.name = image.name;
    array.notes.emplace_back("a PNG in base64");
    found.arrays.push_back(std::move(array));
  }
  if (found.arrays.empty()) {
    throw Error(Fault::Input,
                fmt::format("found no numbers in lines and no array of at least {} numbers, "
                            "expected a table",
                            least_numbers));
  }
  return std::move(found.arrays);
}

}  // namespace

std::vector<NumberArray> read_arrays(const fs::path& path, const ReadLimits& limits) {
  const io::Bytes first = io::first_bytes(path, io::signature_length);
  const std::optional<std::string> format = io::known_format(path, first);
  return with_context(path.string(), [&]() -> std::vector<NumberArray> {
    if (!format) return arrays_of_text(io::all_bytes(path), limits);
    if (*format == "npy") return {io::read_npy_array(io::all_bytes(path), limits)};
    if (is_named_text(path, *format, first)) return arrays_of_text(io::all_bytes(path), limits);
    return {array_of(io::read_volume(path, *format, limits))};
  });
}

}  // namespace kiln
