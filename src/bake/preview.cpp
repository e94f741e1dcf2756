// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include "bakes.h"
#include "preview_blocks.h"
#include "preview_glass.h"
#include "preview_rows.h"

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

Picture make_picture(const Settings& settings, const Svbrdf& maps) {
  const bool ball = settings.shape == PreviewBake::Shape::Sphere;
  return Picture(
      maps, {ball, picture_size(settings, maps.size), parse_view(settings.view), settings.rotate});
}

// Over the pixels that are shown.
double mean_of(const Layers& image, const std::vector<std::string>& names) {
  const Plane& alpha = *image.find("A");
  double sum = 0, shown = 0;
  for (const std::string& name : names) {
    const Plane& plane = *image.find(name);
    for (int y = 0; y < plane.height(); ++y) {
      for (int x = 0; x < plane.width(); ++x) {
        if (alpha.at(x, y) <= 0) continue;
        sum += plane.at(x, y);
        ++shown;
      }
    }
  }
  return shown > 0 ? sum / shown : 0;
}

const std::vector<std::string> shape_words = {"flat", "sphere"};
const std::vector<std::string> mode_words = {"reference", "split-sum", "difference"};
const std::vector<std::string> error_channels = {"stderr.R", "stderr.G", "stderr.B"};
constexpr int most_samples = 1 << 14;

struct Rendered {
  Layers image;
  double mean_samples = 0, most_samples = 0;  ///< of a pixel
  double mean_error = 0;
  double blocks_short = 0;       ///< share of the pixels whose block has not reached its error
  double lost = 0, trapped = 0;  ///< of glass
};

bool is_glass(const ShadingInputs& inputs) { return inputs.surface.bsdf == "glass"; }

// The plane of counts is kept where they differ from place to place.
void count_samples(const Settings& settings, Rendered& rendered) {
  std::vector<Layer>& layers = rendered.image.layers;
  const Plane& counts = layers.at(points_plane).plane;
  rendered.mean_samples = mean_of(rendered.image, {layers.at(points_plane).name});
  for (int y = 0; y < counts.height(); ++y) {
    for (const float count : counts.texels_of_row(y)) {
      rendered.most_samples = std::max(rendered.most_samples, double{count});
    }
  }
  if (settings.target_error <= 0) layers.erase(layers.begin() + points_plane);
}

Rendered render_reference(const Picture& picture, const ShadingInputs& inputs,
                          const Settings& settings) {
  const SamplePlan plan{whole_samples(settings.samples, picture.positions()), most_samples,
                        settings.target_error, settings.seed};
  Rendered rendered;
  if (is_glass(inputs)) {
    GlassPicture glass = estimate_glass(picture, inputs, plan);
    rendered.image = std::move(glass.image);
    rendered.lost = glass.lost;
    rendered.trapped = glass.trapped;
  } else {
    rendered.image = estimate_picture(picture, inputs, plan);
  }
  rendered.mean_error = mean_of(rendered.image, error_channels);
  if (settings.target_error > 0) {
    rendered.blocks_short = share_above(rendered.image, settings.target_error);
  }
  count_samples(settings, rendered);
  return rendered;
}

void subtract(Layers& from, const Layers& image) {
  for (const char* name : {"R", "G", "B"}) {
    auto layer = std::find_if(from.layers.begin(), from.layers.end(),
                              [name](const Layer& l) { return l.name == name; });
    const Plane& other = *image.find(name);
    for (int y = 0; y < from.size.height; ++y) {
      float* to = layer->plane.row(y);
      for (int x = 0; x < from.size.width; ++x) to[x] -= other.at(x, y);
    }
  }
}

std::vector<std::pair<std::string, std::string>> describe_file(const Settings& settings,
                                                               const ShadingInputs& inputs) {
  return {{"kiln:bake", "preview"},
          {"kiln:shape", shape_words[static_cast<size_t>(settings.shape)]},
          {"kiln:mode", mode_words[static_cast<size_t>(settings.mode)]},
          {"kiln:models", surface_words(inputs.surface)}};
}

// What the chosen models make of the picture that the user may not expect.
void add_model_notes(const Settings& settings, const ShadingInputs& inputs, Baked& baked) {
  const SurfaceChoice& surface = inputs.surface;
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

void add_figures(const Settings& settings, const ShadingInputs& inputs, const Rendered& reference,
                 Baked& baked) {
  baked.figures = {{"samples", reference.mean_samples}};
  if (settings.target_error > 0) {
    baked.figures.emplace_back("most samples", reference.most_samples);
  }
  baked.figures.emplace_back("mean standard error", reference.mean_error);
  if (is_glass(inputs)) {
    baked.figures.emplace_back("energy lost", reference.lost);
    baked.figures.emplace_back("light ended inside", reference.trapped);
  }
  if (reference.blocks_short > 0) {
    baked.notes.push_back(
        fmt::format("{:.3g} % of the pixels lie in blocks whose mean standard error is above {} "
                    "after {} samples",
                    100 * reference.blocks_short, settings.target_error, reference.most_samples));
  }
}

}  // namespace

Params<Settings> PreviewBake::params() {
  return {
      word_param("shape", &Settings::shape, shape_words, "a plane or a ball"),
      word_param("mode", &Settings::mode, mode_words,
                 "true light transport, what an engine shows, or the second minus the first"),
      integer_param("samples", &Settings::samples, {1, most_samples},
                    "directions per texel (reference), rounded up to whole repetitions"),
      number_param("target_error", &Settings::target_error, {0, 1e9}, "",
                   "doubles samples of each 16x16 block to this mean error; 0: no"),
      extent_param("size", &Settings::size, {1, 32768}, "of the picture"),
      text_param("view", &Settings::view, "THETA,PHI of the viewer of a plane [degree]"),
      number_param("rotate", &Settings::rotate, {-360, 360}, "[degree]",
                   "turns the environment, positive turns +Z toward +X"),
      text_param("lights", &Settings::lights,
                 "directional lights dir:x,y,z:r,g,b: where from (+Z to the viewer, +Y up), "
                 "irradiance on a plane facing it [W/m^2]"),
      integer_param("seed", &Settings::seed, {0, 2147483647}, "of the sample sets"),
  };
}

Needs PreviewBake::needs(const Settings& settings) {
  return {.material = true,
          .light = true,
          .sampled = true,
          .prefiltered = settings.mode != Mode::Reference,
          .albedo = true,
          .own_lights = !settings.lights.empty()};
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
  const Picture picture = make_picture(settings, *ingredients.material);
  const ShadingInputs inputs{ingredients.light, ingredients.albedo, ingredients.surface,
                             parse_lights(settings.lights)};
  check_surface(inputs.surface);
  check(settings, inputs.surface);
  if (!inputs.light && inputs.lights.empty()) {
    throw Error(Fault::Usage, "nothing to light it with: expected an environment, lights or both");
  }
  Baked baked;
  add_model_notes(settings, inputs, baked);
  Layers image;
  if (settings.mode != Mode::Reference) image = approximate_picture(picture, inputs);
  if (settings.mode != Mode::SplitSum) {
    Rendered reference = render_reference(picture, inputs, settings);
    add_figures(settings, inputs, reference, baked);
    if (settings.mode == Mode::Reference) {
      image = std::move(reference.image);
    } else {
      subtract(image, reference.image);
    }
  }
  Artifact& picture_made = baked.artifacts.emplace_back();
  picture_made.image = std::move(image);
  picture_made.attributes = describe_file(settings, inputs);
  return baked;
}

}  // namespace kiln
