// SPDX-License-Identifier: Apache-2.0
#include "preview_glass.h"

#include "kiln/brdf/rough_dielectric.h"
#include "kiln/brdf/roughness.h"
#include "kiln/integrate/sobol.h"
#include "kiln/parallel/rows.h"
#include "light_product.h"
#include "preview_pixels.h"

namespace kiln {
namespace {

using F = WideFloat;
using Color = Vec3<F>;
using Mask = MaskOf<F>;
constexpr int lanes = lane_count<F>;

// One path a lane. `position` is on the unit ball, in the environment's space.
struct Paths {
  Color position, direction;
  F throughput;
  Mask alive, inside;
};

// Where paths meet the boundary.
struct Boundary {
  Frame<F> frame;  // of the true surface, z outward
  Color normal;    // of the maps, tangent space
  F alpha;
};

struct Harvest {
  Color radiance{F(0.0f), F(0.0f), F(0.0f)};
  F carried = F(0.0f);  // throughput of the paths that left
};

Boundary boundary_of(const TexelBlock<F>& block, const Frame<F>& frame) {
  const TexelValues<F> texel = values_of<F>(block);
  return {frame, texel.normal, to_alpha(texel.roughness)};
}

// The smooth, parallel back of a slab whose front this is.
Boundary back_of(const Boundary& front) {
  const Frame<F>& f = front.frame;
  return {{f.x, -f.y, -f.z}, {F(0.0f), F(0.0f), F(1.0f)}, F(static_cast<float>(min_alpha))};
}

// The normal of the maps, bent so that the path comes from the side of it that it comes from.
Frame<F> shading_frame(const Boundary& at, const Color& back, F side) {
  const Color normal = at.frame.to_world(at.normal) * side;
  return frame_around(bend_toward(normal, back) * side);
}

// Uniform numbers for one meeting: the first from the point set, later ones from hashes.
Color draw(const std::array<std::uint32_t, 4>& point, const std::array<WideUint, 4>& seeds,
           int index, int bounce) {
  const auto number = [&](int d) {
    if (bounce == 0) {
      return unit_float(owen_scramble_reversed<WideUint>(WideUint(point[d]), seeds[d]));
    }
    const auto which = static_cast<std::uint32_t>(index * most_bounces + bounce);
    return unit_float(combine_hash<WideUint>(seeds[d], WideUint(which)));
  };
  return {number(0), number(1), number(2)};
}

// Reflects or refracts; paths that leave are harvested.
void meet(const Boundary& at, F ior, const Color& u, const Environment& environment, Paths& paths,
          Harvest& harvest) {
  const Color back = -paths.direction;
  const F side = select(paths.inside, F(-1.0f), F(1.0f));
  const Frame<F> frame = shading_frame(at, back, side);
  const RoughDielectric<F> glass{at.alpha, at.alpha, ior};
  const DielectricSample<F> drawn = glass.sample(frame.to_local(back), u);
  paths.throughput = paths.throughput * drawn.weight;
  paths.alive = paths.alive && (drawn.weight > F(0.0f));
  Color next = frame.to_world(drawn.wi);
  const F wanted = select(drawn.transmitted, -side, side);
  const F rise = dot(next, at.frame.z);
  next = select(rise * wanted < F(0.0f), next - at.frame.z * (F(2.0f) * rise), next);
  paths.direction = select(paths.alive, next, paths.direction);
  paths.inside = wanted < F(0.0f);
  const Mask leaves = paths.alive && (wanted > F(0.0f));
  if (any(leaves)) {
    const F carried = select(leaves, paths.throughput, F(0.0f));
    harvest.radiance += environment.radiance(paths.direction) * carried;
    harvest.carried += carried;
  }
  paths.alive = paths.alive && (wanted < F(0.0f));
}

// The other end of a chord through the unit ball.
Color across(const Color& position, const Color& direction) {
  return normalize(position - direction * (F(2.0f) * dot(position, direction)));
}

struct GlassBody {
  const Picture& picture;
  const Environment& environment;
  F ior;

  void trace(const Boundary& first, Paths paths, const std::array<std::uint32_t, 4>& point,
             const std::array<WideUint, 4>& seeds, int index, Harvest& harvest) const {
    Boundary at = first;
    const Boundary back = back_of(first);
    for (int bounce = 0; bounce < most_bounces; ++bounce) {
      meet(at, ior, draw(point, seeds, index, bounce), environment, paths, harvest);
      if (!any(paths.alive)) return;
      if (picture.is_ball()) {
        paths.position = across(paths.position, paths.direction);
        TexelBlock<F> block;
        Frame<F> frame;
        picture.fill_on_ball(paths.position, block, frame);
        at = boundary_of(block, frame);
      } else {
        at = bounce % 2 == 0 ? back : first;
      }
    }
  }
};

struct GlassEstimate {
  Estimate radiance;
  F carried;
};

GlassEstimate estimate_texels(const GlassBody& body, const SobolPoints& points, int x, int y,
                              int seed) {
  const WideUint texels = texel_hashes(x, y, seed);
  std::array<Harvest, repetitions> harvests;
  const int positions = body.picture.positions();
  const int share = static_cast<int>(points.size()) / positions;
  for (int position = 0; position < positions; ++position) {
    TexelBlock<F> block;
    Placement<F> placement;
    body.picture.fill<F>(x, y, position, block, placement);
    const Boundary first = boundary_of(block, placement.frame);
    const Paths start{placement.frame.z, -placement.to_viewer, F(1.0f), Mask(true), Mask(false)};
    for (int r = 0; r < repetitions; ++r) {
      const auto seeds = repetition_seeds<WideUint>(texels, static_cast<std::uint32_t>(r));
      for (int i = position * share; i < (position + 1) * share; ++i) {
        body.trace(first, start, points[static_cast<size_t>(i)], seeds, i, harvests[r]);
      }
    }
  }
  const F scale(1.0f / static_cast<float>(points.size()));
  std::array<Color, repetitions> means;
  F carried(0.0f);
  for (int r = 0; r < repetitions; ++r) {
    means[r] = harvests[r].radiance * scale;
    carried += harvests[r].carried * scale * F(1.0f / repetitions);
  }
  return {summarise(means), carried};
}

// Mean of what is lost over the pixels that show the body.
double mean_lost(const Plane& carried, const Plane& alpha) {
  double lost = 0, pixels = 0;
  for (int y = 0; y < carried.height(); ++y) {
    for (int x = 0; x < carried.width(); ++x) {
      if (alpha.at(x, y) <= 0) continue;
      lost += 1 - carried.at(x, y);
      ++pixels;
    }
  }
  return pixels > 0 ? lost / pixels : 0;
}

}  // namespace

GlassPicture estimate_glass(const Picture& picture, const ShadingInputs& inputs, int samples,
                            int seed) {
  GlassPicture made{
      make_layers(picture.size(), {"R", "G", "B", "A", "stderr.R", "stderr.G", "stderr.B"})};
  Layers& image = made.image;
  fill_coverage(picture, image);
  Plane carried(picture.size(), 0);
  const SobolPoints points = sobol_points_reversed(samples / repetitions);
  const GlassBody body{picture, inputs.light->environment,
                       F(static_cast<float>(inputs.surface.ior))};
  for_rows(picture.size().height, [&](int y) {
    for (int x = 0; x < picture.size().width; x += lanes) {
      if (!covers_any(image, x, y)) continue;
      const GlassEstimate e = estimate_texels(body, points, x, y, seed);
      store_color(image, 0, x, y, e.radiance.mean);
      store_color(image, 4, x, y, e.radiance.error);
      store_lanes(carried.row(y) + x, e.carried);
    }
  });
  clear_background(image);
  made.lost = mean_lost(carried, image.layers[3].plane);
  return made;
}

}  // namespace kiln
