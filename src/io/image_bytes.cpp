// SPDX-License-Identifier: Apache-2.0
#include "kiln/io/image_bytes.h"

#include <algorithm>

#include "base64.h"
#include "file_bytes.h"
#include "kiln/core/error.h"
#include "signature.h"
#include "volume_file.h"

namespace kiln {
namespace {

std::string format_of(const ImageBytes& image) {
  if (!image.bytes || image.bytes->empty()) {
    throw Error(Fault::Input, image.name + ": the image is empty (0 bytes)");
  }
  const size_t count = std::min(image.bytes->size(), io::signature_length);
  return io::format_by_contents(image.name, io::ByteView(*image.bytes).first(count));
}

}  // namespace

FileFacts inspect_image(const ImageBytes& image) {
  const std::string format = format_of(image);
  return with_context(image.name, [&] { return io::facts_of_bytes(*image.bytes, format, {}); });
}

ImageFile read_image(const ImageBytes& image, const ReadLimits& limits,
                     const std::vector<std::string>& channels) {
  const std::string format = format_of(image);
  return with_context(image.name, [&] {
    const io::Reading reading{.limits = limits, .channels = channels};
    ImageFile file = io::volume_of_bytes(*image.bytes, format, reading).file;
    std::erase_if(file.image.layers,
                  [&](const Layer& layer) { return !reading.wants(layer.name); });
    return file;
  });
}

std::vector<uint8_t> read_bytes(const std::filesystem::path& path) { return io::all_bytes(path); }

std::optional<std::vector<uint8_t>> decoded_base64(std::string_view text) {
  while (text.ends_with('=')) text.remove_suffix(1);
  const std::string bytes = io::base64_bytes(text);
  if (bytes.size() != text.size() * 6 / 8) return std::nullopt;
  return std::vector<uint8_t>(bytes.begin(), bytes.end());
}

}  // namespace kiln
