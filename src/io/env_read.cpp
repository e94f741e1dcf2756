// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "env_file.h"
#include "kiln/core/error.h"
#include "openimageio_file.h"
#include "orientation.h"
#include "rgbd.h"
#include "samples.h"
#include "signature.h"

namespace kiln::io {
namespace {

using nlohmann::json;

[[noreturn]] void refuse(const std::string& reason) { throw Error(Fault::Input, reason); }

struct Manifest {
  long long width = 0;
  long long levels = 0;
  std::vector<ByteView> images;  // [levels * 6]
  std::optional<IrradiancePolynomial> irradiance;
  std::optional<double> lod_generation_scale;
  Attributes attributes;
  std::vector<std::string> notes;
};

// The member of that name, or null.
const json& member(const json& object, const char* name) {
  static const json none;
  if (!object.is_object()) return none;
  const auto at = object.find(name);
  return at == object.end() ? none : *at;
}

long long whole_number(const json& object, const char* name) {
  const json& value = member(object, name);
  if (!value.is_number_unsigned()) refuse(fmt::format("its manifest has no whole '{}'", name));
  const auto number = value.get<uint64_t>();
  constexpr uint64_t largest = uint64_t{1} << 40;
  if (number > largest) refuse(fmt::format("its manifest's '{}' is {}", name, number));
  return static_cast<long long>(number);
}

ByteView image_at(const json& place, ByteView images) {
  const auto position = static_cast<size_t>(whole_number(place, "position"));
  const auto length = static_cast<size_t>(whole_number(place, "length"));
  if (position > images.size() || length > images.size() - position) {
    refuse(fmt::format("truncated: an image of {} bytes at {} of {}", length, position,
                       images.size()));
  }
  return images.subspan(position, length);
}

IrradiancePolynomial::Color color(const json& object, const char* name) {
  const json& value = member(object, name);
  IrradiancePolynomial::Color numbers{};
  const bool whole = value.is_array() && value.size() == numbers.size() &&
                     std::all_of(value.begin(), value.end(),
                                 [](const json& number) { return number.is_number(); });
  if (!whole) refuse(fmt::format("its irradiance has no three numbers '{}'", name));
  for (size_t c = 0; c < numbers.size(); ++c) numbers[c] = value[c].get<double>();
  return numbers;
}

void read_irradiance(const json& object, Manifest& manifest) {
  if (object.is_null()) return;
  IrradiancePolynomial& p = manifest.irradiance.emplace();
  p = {.x = color(object, "x"),
       .y = color(object, "y"),
       .z = color(object, "z"),
       .xx = color(object, "xx"),
       .yy = color(object, "yy"),
       .zz = color(object, "zz"),
       .yz = color(object, "yz"),
       .zx = color(object, "zx"),
       .xy = color(object, "xy")};
  if (!member(object, "irradianceTexture").is_null()) {
    manifest.notes.emplace_back("its cube of irradiance is not read");
  }
}

void read_attributes(const json& object, Manifest& manifest) {
  if (!object.is_object()) return;
  for (const auto& [name, value] : object.items()) {
    if (value.is_string()) manifest.attributes.emplace_back(name, value.get<std::string>());
  }
}

Manifest manifest_of(ByteView bytes, const ReadLimits& limits) {
  const ByteView behind = bytes.subspan(std::min(env_signature.size(), bytes.size()));
  const auto end = std::find(behind.begin(), behind.end(), 0);
  if (end == behind.end()) refuse("truncated: its manifest has no end");
  const json parsed = json::parse(behind.begin(), end, nullptr, false);
  if (parsed.is_discarded()) refuse("its manifest is no JSON");
  const ByteView images = behind.subspan(static_cast<size_t>(end - behind.begin()) + 1);
  const json& specular = member(parsed, "specular");
  const json& places = member(specular, "mipmaps");
  if (!places.is_array() || places.empty() || places.size() % 6 != 0) {
    refuse(fmt::format("its manifest places {} images, expected six for each level",
                       places.is_array() ? places.size() : 0));
  }
  Manifest manifest;
  manifest.width = whole_number(parsed, "width");
  manifest.levels = static_cast<long long>(places.size() / 6);
  require_levels_within(limits, manifest.width, manifest.width, manifest.levels, 6);
  for (const json& place : places) manifest.images.push_back(image_at(place, images));
  read_irradiance(member(parsed, "irradiance"), manifest);
  const json& scale = member(specular, "lodGenerationScale");
  if (scale.is_number()) manifest.lod_generation_scale = scale.get<double>();
  read_attributes(member(parsed, "attributes"), manifest);
  return manifest;
}

FileFacts facts_of(const Manifest& manifest) {
  FileFacts facts;
  facts.format = "env";
  facts.size = {static_cast<int>(manifest.width), static_cast<int>(manifest.width)};
  facts.channels = {"R", "G", "B"};
  facts.type = PixelType::Half;
  facts.attributes = manifest.attributes;
  facts.notes = manifest.notes;
  return facts;
}

void note_the_rest(const Manifest& manifest, FileFacts& facts) {
  facts.notes.emplace_back("a cube; its first face is read");
  if (manifest.levels > 1) {
    facts.notes.push_back(fmt::format("{} mip levels; the largest is read", manifest.levels));
  }
}

// The image's bytes decoded; a missing divisor is 1.
Layers decoded(const Layers& image) {
  const Plane* alpha = image.find("A");
  Layers result = make_layers(image.size, {"R", "G", "B"});
  for (int y = 0; y < image.size.height; ++y) {
    for (int x = 0; x < image.size.width; ++x) {
      const std::array<float, 3> texel =
          rgbd_color({image.layers[0].plane.at(x, y), image.layers[1].plane.at(x, y),
                      image.layers[2].plane.at(x, y), alpha == nullptr ? 1.0f : alpha->at(x, y)});
      for (size_t c = 0; c < 3; ++c) result.layers[c].plane.at(x, y) = texel[c];
    }
  }
  return result;
}

Layers read_face(const Manifest& manifest, size_t level, size_t face) {
  const long long edge = std::max(1LL, manifest.width >> level);
  const ByteView bytes = manifest.images[level * 6 + face];
  const auto format = known_format({}, bytes.first(std::min(bytes.size(), signature_length)));
  if (format != "png" && format != "webp") refuse("one of its images is neither PNG nor WebP");
  const ImageFile file = read_by_openimageio(
      *format, bytes, {.limits = {.max_texels = edge * edge, .max_channels = 4}});
  const Size size = file.image.size;
  if (size.width != edge || size.height != edge || file.image.layers.size() < 3) {
    refuse(fmt::format("an image of {} x {} texels and {} channels, expected {} x {} and RGBD",
                       size.width, size.height, file.image.layers.size(), edge, edge));
  }
  return oriented(decoded(file.image), 4);
}

}  // namespace

FileFacts inspect_env(ByteView bytes, const ReadLimits& limits) {
  const Manifest manifest = manifest_of(bytes, limits);
  FileFacts facts = facts_of(manifest);
  note_the_rest(manifest, facts);
  return facts;
}

ImageFile read_env(ByteView bytes, const ReadLimits& limits) {
  const Manifest manifest = manifest_of(bytes, limits);
  ImageFile file{read_face(manifest, 0, 0), facts_of(manifest)};
  note_the_rest(manifest, file.facts);
  return file;
}

TextureFile read_env_texture(ByteView bytes, const ReadLimits& limits) {
  const Manifest manifest = manifest_of(bytes, limits);
  TextureFile file;
  for (size_t level = 0; level < static_cast<size_t>(manifest.levels); ++level) {
    std::vector<Layers>& faces = file.texture.levels.emplace_back();
    for (size_t face = 0; face < 6; ++face) faces.push_back(read_face(manifest, level, face));
  }
  file.facts = facts_of(manifest);
  file.stored = PixelType::Rgbd8;
  file.irradiance = manifest.irradiance;
  file.lod_generation_scale = manifest.lod_generation_scale;
  return file;
}

}  // namespace kiln::io
