// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "env_file.h"
#include "kiln/core/error.h"
#include "openimageio_file.h"
#include "orientation.h"
#include "stored_planes.h"
#include "texel_pack.h"

namespace kiln::io {
namespace {

using Json = nlohmann::ordered_json;

// Appends the face's image. @return where it stands
Json write_face(const Layers& face, const std::filesystem::path& path, ByteStream& out,
                WriteFacts& facts) {
  const Layers upside_down = oriented(rgbd_image(face.size, in_file_order(face), facts), 4);
  const StoredPlanes planes = planes_of(upside_down);
  const uint64_t place = out.position();
  const FileToWrite image{path, "png", face.size, {.type = PixelType::Uint8}, out, facts};
  const std::unique_ptr<BandEncoder> encoder = openimageio_encoder(image, planes);
  encoder->add(planes);
  encoder->finish();
  return {{"length", out.position() - place}, {"position", place}};
}

Json irradiance_of(const std::optional<IrradiancePolynomial>& polynomial) {
  if (!polynomial) return nullptr;
  const IrradiancePolynomial& p = *polynomial;
  return {{"x", p.x},   {"y", p.y},   {"z", p.z},   {"xx", p.xx}, {"yy", p.yy},
          {"zz", p.zz}, {"yz", p.yz}, {"zx", p.zx}, {"xy", p.xy}};
}

Json object_of(const Attributes& attributes) {
  Json object = Json::object();
  for (const auto& [name, text] : attributes) {
    if (object.contains(name)) {
      throw Error(Fault::Usage, fmt::format("metadata name '{}' is used twice", name));
    }
    object[name] = text;
  }
  return object;
}

}  // namespace

// Version 1 is what every Babylon.js reads, and its images are PNG. The manifest says how long they
// are, so it is put in front of them.
void write_env(const std::filesystem::path& path, const Texture& texture,
               const TextureWriteOptions& options, ByteStream& out, WriteFacts& facts) {
  Json manifest = {{"version", 1},
                   {"width", texture.levels.front().front().size.width},
                   {"imageType", "image/png"},
                   {"irradiance", irradiance_of(options.irradiance)}};
  if (!options.attributes.empty()) manifest["attributes"] = object_of(options.attributes);
  Json places = Json::array();
  for (const std::vector<Layers>& level : texture.levels) {
    for (const Layers& face : level) places.push_back(write_face(face, path, out, facts));
  }
  manifest["specular"] = {{"mipmaps", std::move(places)},
                          {"lodGenerationScale", options.lod_generation_scale}};
  std::string front(env_signature);
  front += manifest.dump(-1, ' ', true, Json::error_handler_t::replace);
  front += '\0';
  out.insert(0, front);
}

}  // namespace kiln::io
