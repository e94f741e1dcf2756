// SPDX-License-Identifier: Apache-2.0
#include "preview_rows.h"

#include "estimate.h"
#include "kiln/brdf/models.h"
#include "kiln/core/error.h"
#include "kiln/core/names.h"
#include "kiln/parallel/rows.h"
#include "light_product.h"
#include "preview_blocks.h"
#include "preview_staged.h"

namespace kiln {
namespace {

using F = WideFloat;
constexpr int lanes = lane_count<F>;

// A directional light for whole vectors, in the environment's space.
struct DistantLight {
  Vec3<F> toward, irradiance;
};
using DistantLights = std::vector<DistantLight>;

Vec3<F> widened(const Vec3<double>& v) {
  return {F(static_cast<float>(v.x)), F(static_cast<float>(v.y)), F(static_cast<float>(v.z))};
}

DistantLights distant_lights(const Picture& picture, const ShadingInputs& inputs) {
  DistantLights lights;
  for (const DirectionalLight& light : inputs.lights) {
    lights.push_back({widened(picture.to_environment(light.toward)), widened(light.irradiance)});
  }
  return lights;
}

// A shader makes a point of what a picture shows, and sums or approximates its light. Which one is
// decided once per picture, never per texel.

template <class Diffuse>
struct FusedShader {
  const Light* light;
  const ControlLobes* controls;
  const AlbedoTable& albedo;
  Energy energy;

  using Point = ShadingPoint<F, Diffuse>;

  Point point(const TexelValues<F>& texel, const Placement<F>& placement) const {
    return make_shading_point<F, Diffuse>(texel, placement, albedo, energy);
  }
  void add_points(const Point& point, const ScrambledPoints& points, RepetitionSums& sums) const {
    const LightControl<F> known = control(point);
    for (std::uint32_t r = 0; r < repetitions; ++r) {
      sums[r] += sum_points(point, known, *light->environment, albedo, points.set, points.first,
                            points.last, repetition_seeds<WideUint>(points.texels, r));
    }
  }
  LightControl<F> control(const Point& point) const {
    if (controls == nullptr) return no_control<F>();
    const Vec3<F> single = single_reflectance(point);
    const Vec3<F> total = point.surface.specular_reflectance(point.terms_o);
    const F left = clamp(F(1) - max_component(total), F(0), F(1));
    const Vec3<F> diffuse = point.surface.diffuse.albedo(point.wo.z) * left * point.occlusion;
    const Ggx<F>& ggx = point.surface.ggx;
    return make_light_control(*controls, point.frame, point.wo, ggx.alpha_x, ggx.alpha_y, single,
                              diffuse + total - single);
  }
  Vec3<F> reflected(const Point& point, const DistantLight& distant) const {
    return reflect_distant(point, albedo, distant.toward, distant.irradiance);
  }
  Vec3<F> approximation(const Point& point) const {
    const Vec3<F> normal = point.frame.z;
    const Ggx<F>& ggx = point.surface.ggx;
    const Vec3<F> mirrored = engine_direction(point.wo, ggx.alpha_x, ggx.alpha_y, point.roughness);
    const Vec3<F> specular = point.surface.specular_reflectance(point.terms_o);
    const F left = clamp(F(1) - point.surface.greatest.reflectance(point.terms_o), F(0), F(1));
    const Vec3<F> diffuse = point.surface.diffuse.albedo(point.wo.z) * left * point.occlusion;
    return light->chain->lookup(point.frame.to_world(mirrored), point.roughness) * specular +
           light->irradiance->lookup(normal) * diffuse;
  }
};

struct StagedShader {
  const Light* light;
  const ControlLobes* controls;
  const AlbedoTable& albedo;
  SurfaceStages stages;

  StagedPoint point(const TexelValues<F>& texel, const Placement<F>& placement) const {
    return make_staged_point(texel, placement, albedo, stages);
  }
  LightControl<F> control(const StagedPoint& point) const {
    if (controls == nullptr) return no_control<F>();
    const F like_ggx(stages.alpha_is_width ? 1.0f : 0.0f);
    return make_light_control(*controls, point.frame, point.wo, point.alpha_x, point.alpha_y,
                              point.single_o * like_ggx,
                              diffuse_reflectance(point, stages) + point.total_o - point.single_o);
  }
  void add_points(const StagedPoint& point, const ScrambledPoints& points,
                  RepetitionSums& sums) const {
    kiln::add_points(point, control(point), stages, *light->environment, albedo, points, sums);
  }
  Vec3<F> reflected(const StagedPoint& point, const DistantLight& distant) const {
    return reflect_distant(point, stages, albedo, distant.toward, distant.irradiance);
  }
  Vec3<F> approximation(const StagedPoint& point) const {
    return approximate(point, stages, *light);
  }
};

// Calls visit(shader) with the shader of these models.
template <class Visit>
void with_shader(const ShadingInputs& inputs, Visit&& visit) {
  const SurfaceChoice& surface = inputs.surface;
  if (!has_fused_loop(surface)) {
    return visit(StagedShader{inputs.light, inputs.controls, *inputs.albedo, make_stages(surface)});
  }
  const Energy energy = surface.energy == "none" ? Energy::Single : Energy::Multiscatter;
  bool known = false;
  Diffuses::for_each([&]<template <class> class Model>() {
    if (surface.diffuse != Model<float>::name) return;
    known = true;
    visit(FusedShader<Model<F>>{inputs.light, inputs.controls, *inputs.albedo, energy});
  });
  if (!known) {
    throw Error(Fault::Usage, unknown_name("diffuse", surface.diffuse, model_names("diffuse")));
  }
}

template <class Shader>
auto point_at(const Picture& picture, const Shader& shader, int x, int y, int position) {
  TexelBlock<F> block;
  Placement<F> placement;
  picture.fill<F>(x, y, position, block, placement);
  return shader.point(values_of<F>(block), placement);
}

// What directional lights bring, without noise.
template <class Shader>
Vec3<F> sum_lights(const Picture& picture, const Shader& shader, const DistantLights& lights, int x,
                   int y) {
  Vec3<F> sum{F(0), F(0), F(0)};
  if (lights.empty()) return sum;
  for (int position = 0; position < picture.positions(); ++position) {
    const auto point = point_at(picture, shader, x, y, position);
    for (const DistantLight& light : lights) sum += shader.reflected(point, light);
  }
  return sum * F(1.0f / static_cast<float>(picture.positions()));
}

void add_color(Layers& image, int x, int y, const Vec3<F>& color) {
  const auto plane = [&](size_t c) { return image.layers[c].plane.row(y) + x; };
  const Vec3<F> there{load_lanes<F>(plane(0)), load_lanes<F>(plane(1)), load_lanes<F>(plane(2))};
  store_color(image, 0, x, y, there + color);
}

// All positions inside the pixel share each repetition's point set, a piece of it each, so that
// standard errors hold the noise of the light alone.
template <class Shader>
struct ReferenceRenderer {
  const Picture& picture;
  const Shader& shader;
  const SobolPoints& points;
  const DistantLights& lights;
  int seed;
  Layers& image;

  void add(int x, int y, const PointRange& range, PixelSums& sums) const {
    if (range.last == range.first) return;
    const int share = (range.last - range.first) / picture.positions();
    ScrambledPoints part{points, range.first, range.first + share,
                         texel_hashes(x, picture.first_row() + y, seed)};
    for (int position = 0; position < picture.positions(); ++position) {
      shader.add_points(point_at(picture, shader, x, y, position), part, sums.light);
      part.first += share;
      part.last += share;
    }
  }
  void finish(int x, int y, const PixelSums&, int) const {
    if (!lights.empty()) add_color(image, x, y, sum_lights(picture, shader, lights, x, y));
  }
};

template <class Shader>
Vec3<F> approximate_texels(const Picture& picture, const Shader& shader, int x, int y) {
  Vec3<F> sum{F(0), F(0), F(0)};
  for (int position = 0; position < picture.positions(); ++position) {
    sum += shader.approximation(point_at(picture, shader, x, y, position));
  }
  return sum * F(1.0f / static_cast<float>(picture.positions()));
}

}  // namespace

int whole_samples(int wanted, int positions) {
  const int unit = 2 * repetitions * positions;
  return (wanted + unit - 1) / unit * unit;
}

bool has_fused_loop(const SurfaceChoice& surface) {
  return surface.distribution == "ggx" && surface.masking == "smith-correlated" &&
         surface.fresnel == "schlick" && surface.f90 == 1 && surface.coupling == "reciprocal" &&
         (surface.energy == "kulla-conty" || surface.energy == "none");
}

Layers estimate_picture(const Picture& picture, const ShadingInputs& inputs,
                        const SamplePlan& plan) {
  constexpr int directions = 2 * repetitions;  // of a point of every repetition
  Layers image = make_sampled_image(picture);
  const bool sampled = inputs.light != nullptr;
  const Sampling sampling{sampled ? plan.samples / directions : 0, plan.most / directions,
                          sampled ? plan.target_error : 0, plan.seed,
                          sampled && inputs.light->fixed.negative == 0};
  const SobolPoints points = sobol_points_reversed(
      plan.target_error > 0 ? std::max(sampling.most, sampling.points) : sampling.points);
  const DistantLights lights = distant_lights(picture, inputs);
  with_shader(inputs, [&](const auto& shader) {
    const ReferenceRenderer<std::decay_t<decltype(shader)>> renderer{picture, shader,    points,
                                                                     lights,  plan.seed, image};
    sample_blocks(renderer, sampling, image);
  });
  scale_plane(image.layers[points_plane].plane, directions);
  clear_background(picture, image);
  return image;
}

Layers approximate_picture(const Picture& picture, const ShadingInputs& inputs) {
  Layers image = make_layers(picture.size(), {"R", "G", "B", "A"});
  fill_coverage(picture, image);
  const DistantLights lights = distant_lights(picture, inputs);
  with_shader(inputs, [&](const auto& shader) {
    for_rows(picture.size().height, [&](int y) {
      for (int x = 0; x < picture.size().width; x += lanes) {
        if (!covers_any(image, x, y)) continue;
        Vec3<F> color = sum_lights(picture, shader, lights, x, y);
        if (inputs.light) color += approximate_texels(picture, shader, x, y);
        store_color(image, 0, x, y, color);
      }
    });
  });
  clear_background(picture, image);
  return image;
}

}  // namespace kiln
