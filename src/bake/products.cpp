// SPDX-License-Identifier: Apache-2.0
#include "kiln/bake/products.h"

#include <fmt/format.h>

#include "kiln/core/error.h"
#include "kiln/core/names.h"
#include "kiln/light/source.h"
#include "kiln/table/albedo_table.h"
#include "light_product.h"

namespace kiln {
namespace {

Fix fix_named(const std::string& name) {
  if (name == "none") return Fix::None;
  if (name == "zero") return Fix::Zero;
  if (name == "neighbors") return Fix::Neighbors;
  throw Error(Fault::Usage, unknown_name("fix", name, {"none", "zero", "neighbors"}));
}

std::vector<std::string> describe(const Fixed& fixed, const std::string& fix) {
  std::vector<std::string> notes;
  if (fixed.nan + fixed.inf > 0) {
    const std::string fate =
        fix == "neighbors" ? "replaced by the mean of finite neighbours" : "replaced by zero";
    notes.push_back(
        fmt::format("radiance: {} NaN and {} infinite values {}", fixed.nan, fixed.inf, fate));
  }
  if (fixed.negative > 0) {
    notes.push_back(fmt::format("radiance: {} negative values kept", fixed.negative));
  }
  return notes;
}

[[noreturn]] void refuse(const Fixed& fixed, const std::string& where) {
  const TexelPlace& first = *fixed.first;
  throw Error(Fault::Input,
              fmt::format("found {} NaN and {} infinite values, the first at ({}, {}){} in channel "
                          "{}; expected finite radiance (fix none)",
                          fixed.nan, fixed.inf, first.x, first.y, where, first.channel));
}

Fixed repair(SphereImage& sphere, Fix fix) {
  const bool around = sphere.projection == SphereImage::Projection::LatLong;
  Fixed all;
  std::string where;
  for (size_t i = 0; i < sphere.images.size(); ++i) {
    const Fixed fixed = fix_radiance(sphere.images[i], fix, around ? Edges::Around : Edges::End);
    all.nan += fixed.nan;
    all.inf += fixed.inf;
    all.negative += fixed.negative;
    if (all.first || !fixed.first) continue;
    all.first = fixed.first;
    if (sphere.images.size() == 6) where = fmt::format(" of face {}", cube_face_names[i]);
  }
  if (fix == Fix::None && all.first) refuse(all, where);
  return all;
}

void take_latlong(SphereImage image, const LightSettings& settings, Light& light) {
  light.latlong = std::move(image.images.front());
  if (settings.sampled) {
    light.environment.emplace(light.latlong,
                              EnvironmentOptions{image.node_aligned, settings.rotate_deg});
  }
  if (image.node_aligned) light.latlong = texel_centred(light.latlong);
}

void take_other(SphereImage image, const LightSettings& settings, Light& light) {
  if (image.projection == SphereImage::Projection::LatLong && image.node_aligned) {
    image.images.front() = texel_centred(image.images.front());
    image.node_aligned = false;
  }
  light.latlong = picture_of(image);
  light.spread = point_masses_of(image);
  if (settings.sampled) {
    light.environment.emplace(light.latlong, EnvironmentOptions{false, settings.rotate_deg});
  }
  if (image.projection == SphereImage::Projection::Cube) light.cube = std::move(image);
}

}  // namespace

const ControlLobes& Light::controls() const {
  controls_once_.ensure([&] { controls_.emplace(*environment); });
  return *controls_;
}

LightMade make_light(SphereImage image, const LightSettings& settings) {
  auto light = std::make_shared<Light>();
  light->rotate_deg = settings.rotate_deg;
  light->notes = settings.notes;
  light->fixed = repair(image, fix_named(settings.fix));
  if (settings.mirror == Mirror::X) mirror_x(image);
  set_up(image, settings.up);
  if (image.projection == SphereImage::Projection::LatLong && image.up == Up::Y) {
    take_latlong(std::move(image), settings, *light);
  } else {
    take_other(std::move(image), settings, *light);
  }
  if (settings.prefiltered) {
    const ChainOptions options{settings.size, settings.rotate_deg};
    light->chain.emplace(light->latlong, options);
    light->irradiance.emplace(light->masses(), settings.rotate_deg);
  }
  return {light, describe(light->fixed, settings.fix)};
}

std::shared_ptr<const AlbedoTable> make_albedo_table(const SurfaceChoice& surface) {
  return std::make_shared<const AlbedoTable>(
      AlbedoTable::build({surface.distribution, surface.masking, surface.distribution_shape}));
}

}  // namespace kiln
