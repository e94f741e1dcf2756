// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "bakes.h"
#include "kiln/image/projection.h"
#include "kiln/light/chain_error.h"
#include "kiln/light/spherical_harmonics.h"
#include "light_product.h"

namespace kiln {
namespace {

using Json = nlohmann::ordered_json;
using Settings = EnvironmentBake::Settings;

Json to_json(const Vec3<double>& v) { return Json::array({v.x, v.y, v.z}); }

std::string extension_of(const Settings& settings) {
  return settings.format == EnvironmentBake::Format::Exr ? ".exr" : ".hdr";
}

/// An image whose texels are a function of direction, in either layout.
template <class Function>
Layers fill_latlong(Size size, const Function& radiance) {
  Layers image = make_layers(size, {"R", "G", "B"});
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const Vec2<double> uv{(x + 0.5) / size.width, (y + 0.5) / size.height};
      const Vec3<double> d = latlong_to_direction(uv);
      const Vec3<float> value = radiance(
          Vec3<float>{static_cast<float>(d.x), static_cast<float>(d.y), static_cast<float>(d.z)});
      image.layers[0].plane.at(x, y) = value.x;
      image.layers[1].plane.at(x, y) = value.y;
      image.layers[2].plane.at(x, y) = value.z;
    }
  }
  return image;
}

std::vector<Vec3<double>> face_normals(CubeFace face, int edge) {
  std::vector<Vec3<double>> normals;
  for (int y = 0; y < edge; ++y) {
    for (int x = 0; x < edge; ++x) {
      normals.push_back(normalize(cube_to_direction(face, {(x + 0.5) / edge, (y + 0.5) / edge})));
    }
  }
  return normals;
}

Layers irradiance_face(const Layers& masses, CubeFace face, int edge) {
  const auto values = normalised_irradiance(masses, face_normals(face, edge));
  Layers image = make_layers({edge, edge}, {"R", "G", "B"});
  for (int i = 0; i < edge * edge; ++i) {
    image.layers[0].plane.at(i % edge, i / edge) = static_cast<float>(values[i].x);
    image.layers[1].plane.at(i % edge, i / edge) = static_cast<float>(values[i].y);
    image.layers[2].plane.at(i % edge, i / edge) = static_cast<float>(values[i].z);
  }
  return image;
}

void add_cube(Baked& baked, const std::string& stem, const std::string& extension,
              const std::function<Layers(CubeFace)>& face) {
  for (int f = 0; f < 6; ++f) {
    baked.artifacts.push_back(
        {fmt::format("{}_{}", stem, cube_face_names[f]),
         extension,
         face(static_cast<CubeFace>(f)),
         "",
         {{"kiln:bake", "environment"}, {"kiln:face", std::string(cube_face_names[f])}}});
  }
}

void add_specular(Baked& baked, const Settings& settings, const SpecularChain& chain) {
  const std::string extension = extension_of(settings);
  for (int level = 0; level < chain.levels(); ++level) {
    const std::string stem = fmt::format("specular_m{}", level);
    if (settings.layout == EnvironmentBake::Layout::Cube) {
      add_cube(baked, stem, extension, [&](CubeFace face) { return chain.face(level, face); });
      continue;
    }
    const int height = chain.size(level);
    baked.artifacts.push_back(
        {stem,
         extension,
         fill_latlong({2 * height, height},
                      [&](const Vec3<float>& d) { return chain.lookup_level(d, level); }),
         "",
         {{"kiln:bake", "environment"}}});
  }
}

void add_irradiance(Baked& baked, const Settings& settings, const Light& light) {
  const std::string extension = extension_of(settings);
  if (settings.layout == EnvironmentBake::Layout::Cube) {
    add_cube(baked, "irradiance", extension,
             [&](CubeFace face) { return irradiance_face(light.masses(), face, 64); });
    return;
  }
  baked.artifacts.push_back(
      {"irradiance",
       extension,
       IrradianceMap(light.masses()).image(),
       "",
       {{"kiln:bake", "environment"}, {"kiln:quantity", "irradiance over pi"}}});
}

void add_text(Baked& baked, const std::string& name, const Json& json) {
  baked.artifacts.push_back({name, ".json", {}, json.dump(2) + "\n", {}});
}

Json describe_harmonics(const SphericalHarmonics& radiance) {
  Json json = {{"order", radiance.order},
               {"basis",
                "real, no Condon-Shortley sign, L1-1 ~ y, L10 ~ z, L11 ~ x; (l, m) at "
                "l * l + l + m"}};
  const SphericalHarmonics irradiance = irradiance_over_pi(radiance);
  for (const auto& c : radiance.coefficients) json["radiance"].push_back(to_json(c));
  for (const auto& c : irradiance.coefficients) json["irradiance_over_pi"].push_back(to_json(c));
  return json;
}

Json describe_chain(const Settings& settings, const Light& light, const SpecularChain& chain,
                    const std::vector<double>& errors) {
  const bool cube = settings.layout == EnvironmentBake::Layout::Cube;
  Json json = {{"curve", roughness_curve_names[static_cast<size_t>(settings.curve)]},
               {"roughness", Json::array()},
               {"layout", cube ? "cube" : "latlong"},
               {"faces", Json::array()}};
  for (int level = 0; level < chain.levels(); ++level) {
    json["roughness"].push_back(chain.roughness(level));
  }
  if (cube) {
    for (auto name : cube_face_names) json["faces"].push_back(std::string(name));
  }
  json["mean_radiance"] = to_json(mean_radiance(light.masses()));
  json["fixed"] = {{"nan", light.fixed.nan},
                   {"inf", light.fixed.inf},
                   {"negative", light.fixed.negative},
                   {"clamped", 0},
                   {"lost_energy", 0}};
  json["error"] = {{"meaning",
                    "rms at texel centres against brute force, relative to the level's "
                    "mean radiance, before encoding"},
                   {"levels", errors}};
  json["notes"] = light.notes;
  json["version"] = 1;
  return json;
}

}  // namespace

Params<Settings> EnvironmentBake::params() {
  return {
      integer_param("size", &Settings::size, {16, 4096}, "edge of a cube face of the first level"),
      word_param("layout", &Settings::layout, {"cube", "latlong"}, "six faces, or 2N x N"),
      word_param("curve", &Settings::curve, {"filament", "linear"}, "roughness along the levels"),
      word_param("format", &Settings::format, {"exr", "hdr"}, "of the images"),
      integer_param("sh_order", &Settings::sh_order, {0, 32}, "of the spherical harmonics"),
  };
}

Baked EnvironmentBake::bake(const Settings& settings, const Ingredients& ingredients) {
  const Light& light = *ingredients.light;
  const auto curve = static_cast<RoughnessCurve>(settings.curve);
  const SpecularChain chain(light.latlong, {settings.size, curve, 0});
  const std::vector<double> errors = chain_errors(light.latlong, chain);
  Baked baked;
  add_specular(baked, settings, chain);
  add_irradiance(baked, settings, light);
  add_text(baked, "sh", describe_harmonics(project_sh(light.masses(), settings.sh_order)));
  add_text(baked, "env", describe_chain(settings, light, chain, errors));
  for (int level = 1; level < chain.levels(); ++level) {
    baked.figures.emplace_back(fmt::format("rms error of level {}", level), errors[level]);
  }
  return baked;
}

}  // namespace kiln
