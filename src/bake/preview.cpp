// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <memory>
#include <utility>

#include "bakes.h"
#include "preview_contact.h"
#include "preview_difference.h"
#include "preview_render.h"
#include "preview_stages.h"

namespace kiln {
namespace {

using Settings = PreviewBake::Settings;

double parse_angle(std::string_view text, const std::string& whole) {
  double value = 0;
  const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
  if (result.ec != std::errc() || result.ptr != text.data() + text.size()) {
    throw Error(Fault::Usage,
                fmt::format("view: found '{}', expected THETA,PHI [degree], e.g. 45,0", whole));
  }
  return value;
}

// THETA from the normal, PHI counter-clockwise from +X.
Vec3<double> parse_view(const std::string& text) {
  const size_t comma = std::min(text.find(','), text.size());
  const std::string_view all(text);
  const double theta = parse_angle(all.substr(0, comma), text) * pi / 180;
  const double phi =
      comma < text.size() ? parse_angle(all.substr(comma + 1), text) * pi / 180 : 0.0;
  if (!(theta >= 0 && theta < 0.5 * pi)) {
    throw Error(Fault::Usage, fmt::format("view: found THETA in '{}', expected [0, 90)", text));
  }
  return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

Size picture_size(const Settings& settings, Size map) {
  if (settings.size.width > 0) return settings.size;
  const int edge = std::min(1024, std::max(map.width, map.height));
  return settings.shape == PreviewBake::Shape::Sphere ? Size{edge, edge} : map;
}

// A plane on a sheet is seen from before and below, as a table is.
Vec3<double> viewer_of(const Settings& settings) {
  if (!settings.view.empty()) return parse_view(settings.view);
  return parse_view(settings.shape == PreviewBake::Shape::Contact ? "45,-90" : "0,0");
}

Picture make_picture(const Settings& settings, const Svbrdf& maps) {
  const bool ball = settings.shape == PreviewBake::Shape::Sphere;
  return Picture(maps,
                 {ball, picture_size(settings, maps.size), viewer_of(settings), settings.rotate});
}

// A pixel a texel: each row of the picture needs that row of the maps alone.
bool is_made_in_bands(const Settings& settings) {
  return settings.shape == PreviewBake::Shape::Flat && settings.size.width <= 0;
}

// How much of large maps the picture reads; nothing where it reads all.
Size texels_read(const Settings& settings) {
  if (settings.shape == PreviewBake::Shape::Contact) return texels_of_contact_sheet(settings);
  const bool ball = settings.shape == PreviewBake::Shape::Sphere;
  constexpr int any_large = 1 << 20;
  return Picture::texels_read(ball, picture_size(settings, {any_large, any_large}));
}

const std::vector<std::string> shape_words = {"flat", "sphere", "contact"};
const std::vector<std::string> mode_words = {"reference", "split-sum", "difference"};
constexpr int most_cell = 4096;  // of a picture on a contact sheet [texel]

std::vector<std::pair<std::string, std::string>> describe_file(const Settings& settings,
                                                               const ShadingInputs& inputs) {
  return {{"kiln:bake", "preview"},
          {"kiln:shape", shape_words[static_cast<size_t>(settings.shape)]},
          {"kiln:mode", mode_words[static_cast<size_t>(settings.mode)]},
          {"kiln:models", surface_words(inputs.surface)}};
}

// What the chosen models make of the picture that the user may not expect.
void add_model_notes(const Settings& settings, bool anisotropic, const ShadingInputs& inputs,
                     Baked& baked) {
  const SurfaceChoice& surface = inputs.surface;
  if (anisotropic && (is_glass(inputs) || !make_stages(surface).anisotropic)) {
    baked.notes.push_back(fmt::format("anisotropy is not read: {} has one width",
                                      is_glass(inputs) ? "glass" : surface.distribution));
  }
  if (is_glass(inputs)) {
    baked.notes.emplace_back("glass is clear: colours, metallic and occlusion are not read");
    return;
  }
  const double greatest = inputs.albedo->greatest();
  if (greatest > 1 + 1e-3) {
    baked.notes.push_back(
        fmt::format("{} with {} reflects up to {:.3g} times what it receives; no energy is added "
                    "where it gains",
                    surface.distribution, surface.masking, greatest));
  }
  if (settings.mode != PreviewBake::Mode::Reference && surface.distribution != "ggx") {
    baked.notes.push_back(
        fmt::format("split-sum: the prefiltered environment is that of ggx, its terms are those of "
                    "{} with {}",
                    surface.distribution, surface.masking));
  }
}

Told told_of(const Settings& settings, const ShadingInputs& inputs, const PictureFacts& picture) {
  Told told;
  if (settings.mode == PreviewBake::Mode::SplitSum) return told;
  auto& figures = told.figures;
  if (settings.mode == PreviewBake::Mode::Difference &&
      settings.shape != PreviewBake::Shape::Contact) {
    figures = {{"mean radiance", picture.mean_radiance},
               {"mean difference", picture.mean_difference},
               {"rms difference", picture.rms_difference},
               {"greatest difference", picture.greatest_difference}};
  }
  figures.emplace_back("samples", picture.mean_samples);
  if (settings.target_error > 0) figures.emplace_back("most samples", picture.most_samples);
  figures.emplace_back("mean standard error", picture.mean_error);
  if (is_glass(inputs)) {
    figures.emplace_back("energy lost", picture.lost);
    figures.emplace_back("light ended inside", picture.trapped);
  }
  if (picture.above_target > 0) {
    told.notes.push_back(
        fmt::format("{:.3g} % of the pixels lie in blocks whose mean standard error is above {} "
                    "after {} samples",
                    100 * picture.above_target, settings.target_error, picture.most_samples));
  }
  return told;
}

void bake_contact(const Settings& settings, const Svbrdf& maps, const ShadingInputs& inputs,
                  Artifact& made, Rendered& whole) {
  if (std::max(settings.size.width, settings.size.height) > most_cell) {
    throw Error(Fault::Usage, fmt::format("size: found {}x{} for each picture of a contact sheet, "
                                          "expected at most {}",
                                          settings.size.width, settings.size.height, most_cell));
  }
  ContactSheet sheet = make_contact_sheet(maps, inputs, settings, viewer_of(settings));
  whole = std::move(sheet.whole);
  made.view = std::move(sheet.view);
}

void bake_picture(const Settings& settings, const Svbrdf& maps, const ShadingInputs& inputs,
                  Artifact& made, Rendered& whole) {
  whole = render_preview(make_picture(settings, maps), inputs, settings);
  if (settings.mode == PreviewBake::Mode::Difference) made.view = difference_view(whole.image);
}

void bake_whole(const Settings& settings, const Svbrdf& maps, const ShadingInputs& inputs,
                Baked& baked) {
  add_model_notes(settings, !maps.anisotropy.empty(), inputs, baked);
  Artifact& made = baked.artifacts.emplace_back();
  made.attributes = describe_file(settings, inputs);
  Rendered whole;
  if (settings.shape == PreviewBake::Shape::Contact) {
    bake_contact(settings, maps, inputs, made, whole);
  } else {
    bake_picture(settings, maps, inputs, made, whole);
  }
  made.image = std::move(whole.image);
  const Told told = told_of(settings, inputs, whole.facts);
  baked.figures = told.figures;
  baked.notes.insert(baked.notes.end(), told.notes.begin(), told.notes.end());
}

void bake_bands(const Settings& settings, const MapBands& maps, const ShadingInputs& inputs,
                Baked& baked) {
  add_model_notes(settings, maps.find(Slot::Anisotropy) != nullptr, inputs, baked);
  MapSheet& sheet = baked.sheet.emplace();
  Artifact& file = sheet.files.emplace_back();
  file.image = make_layers({}, rendered_planes(settings));
  file.attributes = describe_file(settings, inputs);
  const auto sums = std::make_shared<PictureSums>(maps.size, settings.target_error);
  sheet.make = [&maps, settings, lit = with_controls(inputs, settings, maps.size),
                sums](const MapRows& rows) {
    const Size size{maps.size.width, rows.rows.count};
    const Picture band(maps.svbrdf(rows), {.size = size,
                                           .to_viewer = viewer_of(settings),
                                           .rotate_deg = settings.rotate,
                                           .first_row = rows.rows.first});
    std::vector<Layers> made;
    made.push_back(render_band(band, lit, settings, *sums));
    return made;
  };
  if (settings.mode == PreviewBake::Mode::Difference) {
    sheet.view = LateView{difference_luminance, difference_bands};
  }
  sheet.told = [settings, inputs, sums] { return told_of(settings, inputs, sums->facts()); };
}

}  // namespace

Params<Settings> PreviewBake::params() {
  return {
      word_param("shape", &Settings::shape, shape_words, "a plane, a ball, or a sheet of both"),
      word_param("mode", &Settings::mode, mode_words,
                 "true light transport, what an engine shows, or the second minus the first"),
      integer_param("samples", &Settings::samples, {1, most_samples},
                    "directions per texel, rounded up to whole repetitions"),
      number_param("target_error", &Settings::target_error, {0, 1e9}, "",
                   "doubles samples of each 16x16 block to this mean error; 0: no"),
      extent_param("size", &Settings::size, {1, 32768}, "of the picture"),
      text_param("view", &Settings::view,
                 "THETA,PHI of the viewer of a plane [degree], 0,0 unless given"),
      number_param("rotate", &Settings::rotate, {-360, 360}, "[degree]",
                   "turns the environment, positive turns +Z toward +X"),
      text_param("lights", &Settings::lights,
                 "directional lights dir:x,y,z:r,g,b: where from (+Z to the viewer, +Y up), "
                 "irradiance on a plane facing it [W/m^2]"),
      integer_param("seed", &Settings::seed, {0, 2147483647}, "of the sample sets"),
  };
}

Needs PreviewBake::needs(const Settings& settings) {
  Needs needs{.light = true,
              .sampled = settings.mode != Mode::SplitSum,
              .prefiltered = settings.mode != Mode::Reference,
              .albedo = true,
              .own_lights = !settings.lights.empty()};
  if (is_made_in_bands(settings)) {
    needs.maps.resolved = true;
    needs.maps.made = static_cast<int>(rendered_planes(settings).size());
    needs.late_view = settings.mode == Mode::Difference;
  } else {
    needs.material = true;
    needs.material_for = texels_read(settings);
  }
  return needs;
}

void PreviewBake::check(const Settings& settings, const SurfaceChoice& surface) {
  if (surface.bsdf == "glass" && settings.mode != Mode::Reference) {
    throw Error(Fault::Usage, fmt::format("bsdf: glass is rendered in mode reference only, found "
                                          "mode {}",
                                          mode_words[static_cast<size_t>(settings.mode)]));
  }
  const auto lights = parse_lights(settings.lights);
  if (surface.bsdf == "glass" && !lights.empty()) {
    throw Error(Fault::Usage,
                "lights: no path through glass ends in a directional light; expected an env alone");
  }
}

Baked PreviewBake::bake(const Settings& settings, const Ingredients& ingredients) {
  const ShadingInputs inputs{ingredients.light, ingredients.albedo, ingredients.surface,
                             parse_lights(settings.lights)};
  check_surface(inputs.surface);
  check(settings, inputs.surface);
  if (!inputs.light && inputs.lights.empty()) {
    throw Error(Fault::Usage, "nothing to light it with: expected an environment, lights or both");
  }
  Baked baked;
  if (ingredients.material != nullptr) {
    bake_whole(settings, *ingredients.material, inputs, baked);
  } else {
    bake_bands(settings, *ingredients.maps, inputs, baked);
  }
  return baked;
}

}  // namespace kiln
