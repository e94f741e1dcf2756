// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "bakes.h"
#include "encoding_loss.h"
#include "environment_recipe.h"
#include "kiln/light/dominant_light.h"
#include "kiln/light/filter_error.h"
#include "kiln/light/source.h"
#include "kiln/light/turn.h"
#include "light_filter.h"
#include "light_product.h"

namespace kiln {
namespace {

using Json = nlohmann::ordered_json;
using Settings = EnvironmentBake::Settings;

constexpr int irradiance_size = 64;

Json to_json(const Vec3<double>& v) { return Json::array({v.x, v.y, v.z}); }

/// What is computed, in kiln's axes.
struct Computed {
  std::vector<std::vector<Layers>> specular;  ///< [levels][images]
  std::vector<FilterError> specular_errors;   ///< [levels]; of the first, an average, 0
  std::vector<Layers> irradiance;
  FilterError irradiance_error;
  Vec3<double> mean_radiance;
  SphericalHarmonics harmonics;        ///< of radiance, raw, in the engine's axes, order 2 or more
  std::array<Vec3<double>, 9> shader;  ///< irradiance over pi as shaders sum it, likewise
};

std::vector<FilterLobe> lobes_of(const EnvironmentRecipe& recipe) {
  std::vector<FilterLobe> lobes{FilterLobe{}};  // the clamped cosine, for irradiance
  for (const double roughness : recipe.plan.roughness) {
    if (roughness > 0) lobes.push_back(recipe.lobe(square(roughness)));
  }
  return lobes;
}

// Of a cube its own texels, where these can be kept.
std::vector<Layers> average(const Light& light, const SphereGrid& grid) {
  const bool keeps_faces = light.cube && !light.cube->node_aligned && !grid.at_nodes &&
                           grid.layout == SphereLayout::Cube && grid.rotate_deg == 0;
  return keeps_faces ? average_faces(*light.cube, grid.size)
                     : average_over_texels(light.latlong, grid);
}

Computed compute(const EnvironmentRecipe& recipe, const Light& light) {
  Computed computed;
  computed.harmonics =
      project_sh(light.masses(), std::max(2, recipe.sh_order), recipe.axes, light.rotate_deg);
  computed.mean_radiance = mean_of(computed.harmonics);
  computed.shader = scaled_for_shaders(
      irradiance_over_pi(windowed(up_to(2, computed.harmonics), recipe.sh_window)));
  const LightFilter filter(light, lobes_of(recipe));
  std::vector<FilteredLevel> filtered;
  for (size_t level = 0; level < recipe.plan.sizes.size(); ++level) {
    const SphereGrid grid = recipe.grid(recipe.plan.sizes[level], light.rotate_deg);
    const double roughness = recipe.plan.roughness[level];
    if (roughness == 0) {
      computed.specular.push_back(average(light, grid));
      continue;
    }
    filtered.push_back(filter.filter(recipe.lobe(square(roughness)), grid));
    computed.specular.push_back(filtered.back().images);
  }
  const SphereGrid grid = recipe.grid(irradiance_size, light.rotate_deg);
  filtered.push_back(filter.filter(FilterLobe{}, grid));
  computed.irradiance = filtered.back().images;
  std::vector<FilterError> errors = filter.errors(filtered, luminance(computed.mean_radiance));
  computed.irradiance_error = errors.back();
  errors.pop_back();
  for (const double roughness : recipe.plan.roughness) {
    if (roughness == 0) {
      computed.specular_errors.emplace_back();
    } else {
      computed.specular_errors.push_back(errors.front());
      errors.erase(errors.begin());
    }
  }
  return computed;
}

void turn_to_engine(const Axes& axes, Computed& computed) {
  if (axes.is_identity()) return;
  for (auto& level : computed.specular) level = faces_in(axes, level);
  computed.irradiance = faces_in(axes, computed.irradiance);
}

/// One file, or one per image and level, of the recipe's format.
class Files {
 public:
  Files(const EnvironmentRecipe& recipe, const Computed& computed)
      : recipe_(recipe), irradiance_(computed.shader.begin(), computed.shader.end()) {}

  /// Levels, as one texture or as files "STEM_mN".
  void add_chain(Baked& baked, const std::string& stem, std::vector<std::vector<Layers>> levels,
                 const std::string& quantity) const {
    if (recipe_.format.whole) return add_texture(baked, stem, std::move(levels), quantity);
    for (size_t level = 0; level < levels.size(); ++level) {
      add_images(baked, fmt::format("{}_m{}", stem, level), std::move(levels[level]), quantity);
    }
  }

  /// A level alone.
  void add_level(Baked& baked, const std::string& stem, std::vector<Layers> images,
                 const std::string& quantity) const {
    if (recipe_.format.whole) return add_texture(baked, stem, {std::move(images)}, quantity);
    add_images(baked, stem, std::move(images), quantity);
  }

 private:
  Artifact make(const std::string& name, const std::string& quantity) const {
    Artifact artifact;
    artifact.name = name;
    artifact.extension = recipe_.format.extension;
    artifact.preferred_type = recipe_.encoding;
    artifact.attributes = {{"kiln:bake", "environment"}, {"kiln:quantity", quantity}};
    if (recipe_.format.name == "ktx1") artifact.attributes = {{"sh", harmonics_text()}};
    return artifact;
  }

  void add_texture(Baked& baked, const std::string& stem, std::vector<std::vector<Layers>> levels,
                   const std::string& quantity) const {
    Artifact artifact = make(stem, quantity);
    artifact.texture =
        TextureProduct{{std::move(levels)}, recipe_.zstd, recipe_.format.at_nodes, irradiance_};
    baked.artifacts.push_back(std::move(artifact));
  }

  void add_images(Baked& baked, const std::string& stem, std::vector<Layers> images,
                  const std::string& quantity) const {
    for (size_t i = 0; i < images.size(); ++i) {
      const bool cube = images.size() == 6;
      Artifact artifact =
          make(cube ? fmt::format("{}_{}", stem, cube_face_names[i]) : stem, quantity);
      if (cube) artifact.attributes.emplace_back("kiln:face", std::string(cube_face_names[i]));
      artifact.image = std::move(images[i]);
      baked.artifacts.push_back(std::move(artifact));
    }
  }

  // As Filament reads it: a line for each coefficient.
  std::string harmonics_text() const {
    std::string text;
    for (const Vec3<double>& c : irradiance_)
      text += fmt::format("{:.9g} {:.9g} {:.9g}\n", c.x, c.y, c.z);
    return text;
  }

  const EnvironmentRecipe& recipe_;
  std::vector<Vec3<double>> irradiance_;
};

void add_text(Baked& baked, const std::string& name, const Json& json) {
  Artifact artifact;
  artifact.name = name;
  artifact.extension = ".json";
  artifact.text = json.dump(2) + "\n";
  baked.artifacts.push_back(std::move(artifact));
}

template <class Coefficients>
Json list_of(const Coefficients& coefficients) {
  Json list = Json::array();
  for (const Vec3<double>& c : coefficients) list.push_back(to_json(c));
  return list;
}

Json describe_harmonics(const EnvironmentRecipe& recipe, const Computed& computed) {
  const SphericalHarmonics radiance =
      windowed(up_to(recipe.sh_order, computed.harmonics), recipe.sh_window);
  return {{"order", radiance.order},
          {"basis",
           "real, no Condon-Shortley sign, L1-1 ~ y, L10 ~ z, L11 ~ x; (l, m) at l * l + l + m"},
          {"axes", recipe.axes_text},
          {"window", sh_window_names[static_cast<size_t>(recipe.sh_window)]},
          {"radiance", list_of(radiance.coefficients)},
          {"irradiance_over_pi", list_of(irradiance_over_pi(radiance).coefficients)},
          {"shader",
           {{"meaning",
             "irradiance over pi = c0 + c1 y + c2 z + c3 x + c4 x y + c5 y z + c6 (3 z^2 - 1) + "
             "c7 x z + c8 (x^2 - y^2) of the normal (x, y, z)"},
            {"c", list_of(computed.shader)}}}};
}

Json describe_dominant(const EnvironmentRecipe& recipe, const Light& light) {
  const auto dominant = dominant_light(light.latlong);
  if (!dominant) return nullptr;
  return {{"direction",
           to_json(recipe.axes.to_engine(Turn(light.rotate_deg).to_world(dominant->direction)))},
          {"solid_angle_sr", dominant->solid_angle},
          {"radiance", to_json(dominant->radiance)},
          {"irradiance", to_json(dominant->irradiance)}};
}

Json describe_errors(const Computed& computed) {
  Json levels = Json::array(), greatest = Json::array();
  for (const FilterError& error : computed.specular_errors) {
    levels.push_back(error.rms);
    greatest.push_back(error.max);
  }
  return {{"meaning",
           "at texel centres against brute force over all texels of the source, around the "
           "brightest too, relative to the mean radiance, before encoding"},
          {"levels", levels},
          {"levels_max", greatest},
          {"irradiance", computed.irradiance_error.rms},
          {"irradiance_max", computed.irradiance_error.max}};
}

Json describe(const EnvironmentRecipe& recipe, const Light& light, const Computed& computed,
              const EncodingLoss& loss) {
  Json json = {{"curve", recipe.curve},
               {"roughness", recipe.plan.roughness},
               {"distribution", recipe.distribution},
               {"layout", sphere_layout_names[static_cast<size_t>(recipe.layout)]},
               {"faces", Json::array()},
               {"axes", recipe.axes_text},
               {"format", recipe.format.name},
               {"encoding", recipe.encoding}};
  if (recipe.layout == SphereLayout::Cube) {
    for (const auto name : cube_face_names) json["faces"].push_back(std::string(name));
  }
  if (!recipe.preset.name.empty()) json["preset"] = recipe.preset.name;
  json["source"] = light.notes;
  json["mean_radiance"] = to_json(computed.mean_radiance);
  json["dominant_light"] = describe_dominant(recipe, light);
  json["fixed"] = {{"nan", light.fixed.nan},
                   {"inf", light.fixed.inf},
                   {"negative", light.fixed.negative},
                   {"clamped", loss.clamped},
                   {"lost_energy", loss.lost_energy}};
  json["error"] = describe_errors(computed);
  json["error"]["encoding"] = {{"meaning", "over all texels, relative to the mean radiance"},
                               {"rms", loss.rms},
                               {"max", loss.max}};
  json["version"] = 1;
  return json;
}

void add_figures(const EnvironmentRecipe& recipe, const Computed& computed,
                 const EncodingLoss& loss, Baked& baked) {
  for (size_t level = 0; level < computed.specular_errors.size(); ++level) {
    const double roughness = recipe.plan.roughness[level];
    if (roughness == 0) continue;
    const FilterError& error = computed.specular_errors[level];
    const std::string name = fmt::format("level {}, roughness {:.3f}", level, roughness);
    baked.figures.emplace_back(name + ": rms error", error.rms);
    baked.figures.emplace_back(name + ": greatest error", error.max);
  }
  baked.figures.emplace_back(fmt::format("encoding {}: rms error", recipe.encoding), loss.rms);
  if (loss.clamped == 0) return;
  baked.notes.push_back(
      fmt::format("{} values beyond the range of {} are clamped, {:.3g} of the energy is lost",
                  loss.clamped, recipe.encoding, loss.lost_energy));
}

}  // namespace

Needs EnvironmentBake::needs(const Settings& settings) {
  resolve_environment(settings);
  return {.light = true};
}

Baked EnvironmentBake::bake(const Settings& settings, const Ingredients& ingredients) {
  const EnvironmentRecipe recipe = resolve_environment(settings);
  const Light& light = *ingredients.light;
  Computed computed = compute(recipe, light);
  EncodingLoss loss;
  if (ingredients.coded) {
    loss = measure_encoding(computed.specular, recipe.grid(settings.size, 0), recipe.encoding,
                            luminance(computed.mean_radiance), ingredients.coded);
  }
  turn_to_engine(recipe.axes, computed);
  Baked baked;
  baked.notes = recipe.preset.cautions;
  add_figures(recipe, computed, loss, baked);
  add_text(baked, "sh", describe_harmonics(recipe, computed));
  add_text(baked, "env", describe(recipe, light, computed, loss));
  const Files files(recipe, computed);
  if (!recipe.preset.skybox.empty()) {
    files.add_level(baked, recipe.preset.skybox, computed.specular.front(), "radiance");
  }
  files.add_chain(baked, recipe.preset.specular, std::move(computed.specular), "radiance");
  if (recipe.format.name != "env") {  // which holds irradiance beside the chain
    files.add_level(baked, recipe.preset.irradiance, std::move(computed.irradiance),
                    "irradiance over pi");
  }
  return baked;
}

}  // namespace kiln
