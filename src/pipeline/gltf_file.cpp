// SPDX-License-Identifier: Apache-2.0
#include "gltf_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "image_uri.h"

namespace kiln {
namespace {

constexpr uint32_t magic = 0x46546c67;       // "glTF"
constexpr uint32_t json_chunk = 0x4e4f534a;  // "JSON"
constexpr uint32_t binary_chunk = 0x004e4942;

// Those that materials are read with, and those that change nothing about how: geometry, lights,
// layers that are not rendered.
constexpr std::array<std::string_view, 24> known_extensions = {
    "KHR_materials_specular",
    "KHR_materials_ior",
    "KHR_materials_pbrSpecularGlossiness",
    "KHR_materials_anisotropy",
    "KHR_materials_emissive_strength",
    "KHR_materials_clearcoat",
    "KHR_materials_sheen",
    "KHR_materials_transmission",
    "KHR_materials_volume",
    "KHR_materials_iridescence",
    "KHR_materials_dispersion",
    "KHR_materials_unlit",
    "KHR_materials_variants",
    "KHR_materials_diffuse_transmission",
    "KHR_texture_transform",
    "KHR_mesh_quantization",
    "KHR_draco_mesh_compression",
    "EXT_meshopt_compression",
    "EXT_mesh_gpu_instancing",
    "KHR_lights_punctual",
    "KHR_animation_pointer",
    "KHR_xmp_json_ld",
    "EXT_texture_webp",
    "MSFT_texture_dds"};

uint32_t number_at(const std::vector<uint8_t>& bytes, size_t at) {
  uint32_t number = 0;
  for (size_t i = 0; i < 4; ++i) number |= static_cast<uint32_t>(bytes[at + i]) << (8 * i);
  return number;
}

std::string text_of(const std::vector<uint8_t>& bytes, size_t first, size_t count) {
  const auto begin = bytes.begin() + static_cast<std::ptrdiff_t>(first);
  return {begin, begin + static_cast<std::ptrdiff_t>(count)};
}

}  // namespace

GltfFile::GltfFile(const std::filesystem::path& path) : path_(path) {
  const std::vector<uint8_t> bytes = read_bytes(path);
  if (bytes.size() >= 12 && number_at(bytes, 0) == magic) {
    read_binary(bytes);
  } else {
    json_ = parse_json(text_of(bytes, 0, bytes.size()), path.string());
  }
  check_version();
  check_extensions();
}

// A header of 12 bytes, then chunks: length, type, bytes. The first is JSON, the second may be BIN.
void GltfFile::read_binary(const std::vector<uint8_t>& bytes) {
  const auto refuse = [&](const std::string& what) {
    throw Error(Fault::Input, fmt::format("{}: {}", path_.string(), what));
  };
  if (const uint32_t version = number_at(bytes, 4); version != 2) {
    refuse(fmt::format("binary glTF of version {}, expected 2", version));
  }
  if (number_at(bytes, 8) > bytes.size()) {
    refuse(fmt::format("truncated: {} bytes, the header promises {}", bytes.size(),
                       number_at(bytes, 8)));
  }
  bool has_json = false;
  for (size_t at = 12; at + 8 <= bytes.size();) {
    const size_t length = number_at(bytes, at);
    const uint32_t type = number_at(bytes, at + 4);
    at += 8;
    if (length > bytes.size() - at) refuse(fmt::format("truncated: a chunk ends beyond the file"));
    if (type == json_chunk && !has_json) {
      json_ = parse_json(text_of(bytes, at, length), path_.string());
      has_json = true;
    } else if (type == binary_chunk && binary_.empty()) {
      const auto begin = bytes.begin() + static_cast<std::ptrdiff_t>(at);
      binary_.assign(begin, begin + static_cast<std::ptrdiff_t>(length));
    }
    at += length;
  }
  if (!has_json) refuse("no chunk of JSON");
}

void GltfFile::check_version() const {
  const auto asset = root().find("asset");
  if (!asset) root().refuse("no `asset`: expected glTF 2.0");
  const std::string version = asset->text("version");
  if (!version.starts_with("2.")) {
    asset->refuse(fmt::format("version is '{}', expected 2.0", version));
  }
}

void GltfFile::check_extensions() const {
  const auto required = root().find("extensionsRequired");
  if (!required) return;
  for (const Json& extension : json_.at("extensionsRequired")) {
    const std::string name = extension.is_string() ? extension.get<std::string>() : "";
    const bool known = std::count(known_extensions.begin(), known_extensions.end(), name) > 0;
    if (!known) required->refuse(fmt::format("'{}' is required, and not known here", name));
  }
}

GltfFile::Image GltfFile::image_of(const JsonAt& texture) {
  std::optional<size_t> source = texture.index("source");
  if (const auto extensions = texture.find("extensions")) {
    for (const char* name : {"EXT_texture_webp", "MSFT_texture_dds"}) {
      const auto other = extensions->find(name);
      if (!source && other) source = other->index("source");
    }
    if (!source && extensions->find("KHR_texture_basisu")) {
      texture.refuse("its only image is in Basis Universal, which is not read");
    }
  }
  if (!source) texture.refuse("no image: `source` is missing");
  const std::vector<JsonAt> images = root().items("images");
  if (*source >= images.size()) {
    texture.refuse(fmt::format("source is {}, there are {} images", *source, images.size()));
  }
  const std::string where = images[*source].where();
  const auto found = images_.find(where);
  if (found != images_.end()) return found->second;
  return images_[where] = image(images[*source]);
}

GltfFile::Image GltfFile::image(const JsonAt& image) {
  Image result;
  std::vector<uint8_t> bytes;
  if (image.find("uri")) {
    UriTarget target = with_context(path_.string() + ": " + image.where(), [&] {
      return resolve_uri(image.text("uri"), path_.parent_path());
    });
    if (!target.bytes) return {target.path, {}};
    bytes = *std::move(target.bytes);
  } else {
    bytes = bytes_of_view(image);
  }
  const std::string name = image.text("name", image.where());
  result.embedded.name = fmt::format("{}#{}", path_.string(), name);
  result.path = fmt::format("{}#{}", path_.string(), image.where());
  result.embedded.bytes = std::make_shared<const std::vector<uint8_t>>(std::move(bytes));
  return result;
}

std::vector<uint8_t> GltfFile::bytes_of_view(const JsonAt& image) {
  const auto index = image.index("bufferView");
  if (!index) image.refuse("neither `uri` nor `bufferView`");
  const std::vector<JsonAt> views = root().items("bufferViews");
  if (*index >= views.size()) {
    image.refuse(fmt::format("bufferView is {}, there are {}", *index, views.size()));
  }
  const JsonAt& view = views[*index];
  const std::vector<uint8_t>& bytes = buffer(view);
  const size_t offset = view.index("byteOffset").value_or(0);
  const size_t length = view.index("byteLength").value_or(0);
  if (offset > bytes.size() || length > bytes.size() - offset) {
    view.refuse(
        fmt::format("{} bytes from {} on, the buffer has {}", length, offset, bytes.size()));
  }
  const auto begin = bytes.begin() + static_cast<std::ptrdiff_t>(offset);
  return {begin, begin + static_cast<std::ptrdiff_t>(length)};
}

const std::vector<uint8_t>& GltfFile::buffer(const JsonAt& view) {
  const size_t index = view.index("buffer").value_or(0);
  const std::vector<JsonAt> buffers = root().items("buffers");
  if (index >= buffers.size()) {
    view.refuse(fmt::format("buffer is {}, there are {}", index, buffers.size()));
  }
  if (!buffers[index].find("uri")) {
    if (binary_.empty() || index > 0) buffers[index].refuse("no `uri`, and no binary chunk");
    return binary_;
  }
  const auto found = buffers_.find(index);
  if (found != buffers_.end()) return found->second;
  UriTarget target = with_context(path_.string() + ": " + buffers[index].where(), [&] {
    return resolve_uri(buffers[index].text("uri"), path_.parent_path());
  });
  return buffers_[index] = target.bytes ? *std::move(target.bytes) : read_bytes(target.path);
}

}  // namespace kiln
