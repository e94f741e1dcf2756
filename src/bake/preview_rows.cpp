// SPDX-License-Identifier: Apache-2.0
#include "preview_rows.h"

#include "estimate.h"
#include "kiln/brdf/models.h"
#include "kiln/core/error.h"
#include "kiln/core/names.h"
#include "kiln/parallel/rows.h"
#include "light_product.h"

namespace kiln {
namespace {

using F = WideFloat;
constexpr int lanes = lane_count<F>;

// Calls visit.operator()<Model>() for the diffuse model of that name: once per bake, never per
// texel.
template <class Visit>
void with_diffuse(const std::string& name, Visit&& visit) {
  bool known = false;
  Diffuses::for_each([&]<template <class> class Model>() {
    if (name != Model<float>::name) return;
    known = true;
    visit.template operator()<Model<F>>();
  });
  if (!known)
    throw Error(Fault::Usage, unknown_name("diffuse model", name, model_names("diffuse")));
}

void store_color(Layers& image, int first_plane, int x, int y, const Vec3<F>& color) {
  store_lanes(image.layers[first_plane].plane.row(y) + x, color.x);
  store_lanes(image.layers[first_plane + 1].plane.row(y) + x, color.y);
  store_lanes(image.layers[first_plane + 2].plane.row(y) + x, color.z);
}

template <class Diffuse>
ShadingPoint<F, Diffuse> point_at(const Picture& picture, const ShadingInputs& inputs, int x, int y,
                                  int position) {
  TexelBlock<F> block;
  Placement<F> placement;
  picture.fill<F>(x, y, position, block, placement);
  return make_shading_point<F, Diffuse>(values_of<F>(block), placement, *inputs.albedo,
                                        inputs.energy);
}

WideUint texel_hashes(int x, int y, int seed) {
  std::uint32_t hashes[lanes];
  for (int lane = 0; lane < lanes; ++lane) {
    const auto row = combine_hash<std::uint32_t>(static_cast<std::uint32_t>(seed),
                                                 static_cast<std::uint32_t>(y));
    hashes[lane] = combine_hash<std::uint32_t>(row, static_cast<std::uint32_t>(x + lane));
  }
  return WideUint::load_unaligned(hashes);
}

struct Estimate {
  Vec3<F> mean, error;
};

// Mean and standard error of the mean of independent repetitions.
Estimate summarise(const std::array<Vec3<F>, repetitions>& means) {
  Vec3<F> mean{F(0), F(0), F(0)}, squares{F(0), F(0), F(0)};
  for (const Vec3<F>& one : means) mean += one;
  mean = mean * F(1.0f / repetitions);
  for (const Vec3<F>& one : means) {
    const Vec3<F> d = one - mean;
    squares += d * d;
  }
  const F scale(1.0f / (repetitions * (repetitions - 1)));
  return {mean, {sqrt(squares.x * scale), sqrt(squares.y * scale), sqrt(squares.z * scale)}};
}

// All positions inside the pixel share each repetition's point set, a piece of it each, so that
// standard errors hold the noise of the light alone.
template <class Diffuse>
Estimate estimate_texels(const Picture& picture, const ShadingInputs& inputs,
                         const SobolPoints& points, int x, int y, int seed) {
  const WideUint texels = texel_hashes(x, y, seed);
  std::array<Vec3<F>, repetitions> sums;
  sums.fill({F(0), F(0), F(0)});
  const int share = static_cast<int>(points.size()) / picture.positions();
  for (int position = 0; position < picture.positions(); ++position) {
    const auto point = point_at<Diffuse>(picture, inputs, x, y, position);
    for (int r = 0; r < repetitions; ++r) {
      sums[r] +=
          sum_points(point, inputs.light->environment, *inputs.albedo, points, position * share,
                     (position + 1) * share, repetition_seeds<WideUint>(texels, r));
    }
  }
  for (Vec3<F>& sum : sums) sum = sum * F(1.0f / static_cast<float>(points.size()));
  return summarise(sums);
}

template <class Diffuse>
Vec3<F> approximate_texels(const ShadingPoint<F, Diffuse>& point, const Light& light) {
  const Vec3<F> normal = point.frame.z;
  const Vec3<F> mirrored{-point.wo.x, -point.wo.y, point.wo.z};
  const Vec3<F> specular = point.surface.specular_reflectance(point.terms_o);
  const F left = clamp(F(1) - point.surface.greatest.reflectance(point.terms_o), F(0), F(1));
  const Vec3<F> diffuse = point.surface.diffuse.albedo(point.wo.z) * left * point.occlusion;
  return light.chain->lookup(point.frame.to_world(mirrored), point.roughness) * specular +
         light.irradiance->lookup(normal) * diffuse;
}

void fill_coverage(const Picture& picture, Layers& image) {
  Plane& alpha = image.layers[3].plane;
  for (int y = 0; y < picture.size().height; ++y) {
    for (int x = 0; x < picture.size().width; ++x) alpha.at(x, y) = picture.coverage(x, y);
  }
}

// Off the ball there is no colour either.
void clear_background(Layers& image) {
  const Plane& alpha = image.layers[3].plane;
  for (size_t l = 0; l < image.layers.size(); ++l) {
    if (l == 3) continue;
    for (int y = 0; y < image.size.height; ++y) {
      float* row = image.layers[l].plane.row(y);
      for (int x = 0; x < image.size.width; ++x) row[x] = alpha.at(x, y) > 0 ? row[x] : 0;
    }
  }
}

bool covers_any(const Layers& image, int x, int y) {
  const float* alpha = image.layers[3].plane.row(y) + x;
  return std::any_of(alpha, alpha + lanes, [](float a) { return a > 0; });
}

}  // namespace

int whole_samples(int wanted, int positions) {
  const int unit = 2 * repetitions * positions;
  return (wanted + unit - 1) / unit * unit;
}

Layers estimate_picture(const Picture& picture, const ShadingInputs& inputs, int samples,
                        int seed) {
  Layers image =
      make_layers(picture.size(), {"R", "G", "B", "A", "stderr.R", "stderr.G", "stderr.B"});
  fill_coverage(picture, image);
  const SobolPoints points = sobol_points_reversed(samples / (2 * repetitions));
  with_diffuse(inputs.diffuse, [&]<class Diffuse>() {
    for_rows(picture.size().height, [&](int y) {
      for (int x = 0; x < picture.size().width; x += lanes) {
        if (!covers_any(image, x, y)) continue;
        const Estimate e = estimate_texels<Diffuse>(picture, inputs, points, x, y, seed);
        store_color(image, 0, x, y, e.mean);
        store_color(image, 4, x, y, e.error);
      }
    });
  });
  clear_background(image);
  return image;
}

Layers approximate_picture(const Picture& picture, const ShadingInputs& inputs) {
  Layers image = make_layers(picture.size(), {"R", "G", "B", "A"});
  fill_coverage(picture, image);
  with_diffuse(inputs.diffuse, [&]<class Diffuse>() {
    for_rows(picture.size().height, [&](int y) {
      for (int x = 0; x < picture.size().width; x += lanes) {
        if (!covers_any(image, x, y)) continue;
        Vec3<F> sum{F(0), F(0), F(0)};
        for (int position = 0; position < picture.positions(); ++position) {
          sum +=
              approximate_texels(point_at<Diffuse>(picture, inputs, x, y, position), *inputs.light);
        }
        store_color(image, 0, x, y, sum * F(1.0f / static_cast<float>(picture.positions())));
      }
    });
  });
  clear_background(image);
  return image;
}

}  // namespace kiln
