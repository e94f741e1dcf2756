// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <map>

#include "kiln/bake/bake.h"
#include "kiln/bake/products.h"
#include "kiln/image/projection.h"
#include "kiln/material/svbrdf.h"

namespace kiln::test {

/// A material that is the same everywhere.
struct Uniform {
  Size size{16, 16};
  float diffuse = 0.5f, f0 = 0.04f, roughness = 0.5f, occlusion = 1;
  Vec3<float> normal{0, 0, 1};
};

inline Svbrdf uniform_svbrdf(const Uniform& u) {
  Svbrdf s;
  s.name = "uniform";
  s.size = u.size;
  const float normal[3] = {u.normal.x, u.normal.y, u.normal.z};
  for (int c = 0; c < 3; ++c) {
    s.diffuse_color[c] = Plane(u.size, u.diffuse);
    s.f0[c] = Plane(u.size, u.f0);
    s.normal[c] = Plane(u.size, normal[c]);
  }
  s.roughness = Plane(u.size, u.roughness);
  s.ambient_occlusion = Plane(u.size, u.occlusion);
  return s;
}

/// A lat-long environment whose radiance is a function of direction, grey.
template <class Radiance>
Layers make_latlong(Size size, const Radiance& radiance) {
  Layers image = make_layers(size, {"R", "G", "B"});
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const Vec2<double> uv{(x + 0.5) / size.width, (y + 0.5) / size.height};
      const auto value = static_cast<float>(radiance(latlong_to_direction(uv)));
      for (Layer& layer : image.layers) layer.plane.at(x, y) = value;
    }
  }
  return image;
}

inline Layers constant_latlong(double radiance) {
  return make_latlong({64, 32}, [=](const Vec3<double>&) { return radiance; });
}

using Settings = std::vector<std::pair<std::string, std::string>>;

/// What a preview is made of, kept for as long as it is made.
struct PreviewScene {
  Baked baked;
  LightMade light;
};

inline bool same_texels(const Plane& a, const Plane& b) {
  bool same = a.size() == b.size();
  for (int y = 0; same && y < a.height(); ++y) {
    same = std::ranges::equal(a.texels_of_row(y), b.texels_of_row(y));
  }
  return same;
}

inline bool same_planes(const Layers& a, const Layers& b) {
  return std::ranges::equal(a.layers, b.layers, [](const Layer& x, const Layer& y) {
    return same_texels(x.plane, y.plane);
  });
}

/// The light of an environment, kept for the next picture that is lit by the same.
inline LightMade light_of(const Layers& latlong, bool prefiltered) {
  static Layers kept;
  static bool kept_prefiltered = false;
  static LightMade made;
  if (!made.light || prefiltered != kept_prefiltered || !same_planes(kept, latlong)) {
    LightSettings settings;
    settings.prefiltered = prefiltered;
    settings.size = 32;
    made = make_light(latlong_image(latlong), settings);
    kept = latlong;
    kept_prefiltered = prefiltered;
  }
  return made;
}

/// Bakes a preview of what `of` holds of a set, in `latlong` with the given settings; without an
/// environment where that has no planes.
inline PreviewScene bake_scene(Ingredients of, const Layers& latlong, const Settings& settings,
                               const SurfaceChoice& surface = {}) {
  const auto recipe = make_recipe("preview");
  for (const auto& [name, value] : settings) recipe->set(name, value);
  LightMade made;
  if (!latlong.layers.empty()) made = light_of(latlong, recipe->needs().prefiltered);
  static std::map<std::string, std::shared_ptr<const AlbedoTable>> albedos;
  auto& albedo = albedos[surface.distribution + surface.masking];
  if (!albedo && of.albedo == nullptr) albedo = make_albedo_table(surface);
  of.light = made.light.get();
  if (of.albedo == nullptr) of.albedo = albedo.get();
  of.surface = surface;
  return {recipe->bake(of), std::move(made)};
}

/// The same of a whole set.
/// @param shared  a table of albedos to use instead of the lobe's own
inline Baked bake_preview(const Svbrdf& material, const Layers& latlong, const Settings& settings,
                          const SurfaceChoice& surface = {}, const AlbedoTable* shared = nullptr) {
  Ingredients ingredients;
  ingredients.material = &material;
  ingredients.albedo = shared;
  return bake_scene(ingredients, latlong, settings, surface).baked;
}

inline Layers preview(const Svbrdf& material, const Layers& latlong, const Settings& settings,
                      const std::string& diffuse = "eon") {
  SurfaceChoice surface;
  surface.diffuse = diffuse;
  return bake_preview(material, latlong, settings, surface).artifacts.at(0).image;
}

inline double mean(const Plane& plane) {
  double sum = 0;
  for (int y = 0; y < plane.height(); ++y) {
    for (float value : plane.texels_of_row(y)) sum += value;
  }
  return sum / static_cast<double>(area(plane.size()));
}

}  // namespace kiln::test
