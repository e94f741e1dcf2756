// SPDX-License-Identifier: Apache-2.0
#include "kiln/bake/products.h"

#include <fmt/format.h>

#include "kiln/core/error.h"
#include "kiln/core/names.h"
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

}  // namespace

LightMade make_light(Layers latlong, const LightSettings& settings) {
  const Fix fix = fix_named(settings.fix);
  const Fixed fixed = fix_radiance(latlong, fix);
  if (fix == Fix::None && fixed.nan + fixed.inf > 0) {
    throw Error(Fault::Input,
                fmt::format("found {} NaN and {} infinite values, expected finite radiance (fix: "
                            "none)",
                            fixed.nan, fixed.inf));
  }
  Environment environment(latlong, {settings.node_aligned, settings.rotate_deg});
  if (settings.node_aligned) latlong = texel_centred(latlong);
  auto light = std::make_shared<Light>(
      Light{std::move(latlong), settings.rotate_deg, fixed, std::move(environment), {}, {}});
  if (settings.prefiltered) {
    const ChainOptions options{settings.size, settings.rotate_deg};
    light->chain.emplace(light->latlong, options);
    light->irradiance.emplace(light->latlong, settings.rotate_deg);
  }
  return {light, describe(fixed, settings.fix)};
}

std::shared_ptr<const AlbedoTable> make_albedo_table(const SurfaceChoice& surface) {
  return std::make_shared<const AlbedoTable>(
      AlbedoTable::build({surface.distribution, surface.masking, surface.distribution_shape}));
}

}  // namespace kiln
