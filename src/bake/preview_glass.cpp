// SPDX-License-Identifier: Apache-2.0
#include "preview_glass.h"

#include "glass_albedos.h"
#include "kiln/brdf/rough_dielectric.h"
#include "kiln/brdf/roughness.h"
#include "kiln/integrate/sobol.h"
#include "light_product.h"
#include "preview_blocks.h"

namespace kiln {
namespace {

using F = WideFloat;
using Color = Vec3<F>;
using Mask = MaskOf<F>;

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
  F roughness;
};

struct Harvest {
  Color radiance{F(0.0f), F(0.0f), F(0.0f)};
  F carried = F(0.0f);  // throughput of the paths that left
  F trapped = F(0.0f);  // of which were ended inside

  void add(const Color& light, F throughput) {
    radiance += light * throughput;
    carried += throughput;
  }
};

Boundary boundary_of(const TexelBlock<F>& block, const Frame<F>& frame) {
  const TexelValues<F> texel = values_of<F>(block);
  return {frame, texel.normal, clamp(texel.roughness, F(0.0f), F(1.0f))};
}

// The smooth, parallel back of a slab whose front this is.
Boundary back_of(const Boundary& front) {
  const Frame<F>& f = front.frame;
  return {{f.x, -f.y, -f.z}, {F(0.0f), F(0.0f), F(1.0f)}, F(0.0f)};
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

// What paths meet and end in.
struct GlassBody {
  const Picture& picture;
  const Environment& environment;
  F ior;
  const GlassAlbedos* albedos;  // null: what the single bounce loses stays lost
};

// Reflects or refracts, as one draw of the BSDF says.
void meet(const GlassBody& body, const Boundary& at, const Color& u, Paths& paths) {
  const F side = select(paths.inside, F(-1.0f), F(1.0f));
  const Frame<F> frame = shading_frame(at, -paths.direction, side);
  const Color wo = frame.to_local(-paths.direction);
  const F alpha = to_alpha(at.roughness);
  const DielectricSample<F> drawn = RoughDielectric<F>{alpha, alpha, body.ior}.sample(wo, u);
  F weight = drawn.weight;
  if (body.albedos) weight = weight / body.albedos->total(abs(wo.z), at.roughness, paths.inside);
  paths.throughput = select(paths.alive, paths.throughput * weight, F(0.0f));
  paths.alive = paths.alive && (drawn.weight > F(0.0f));
  const Color next = frame.to_world(drawn.wi);
  const F wanted = select(drawn.transmitted, -side, side);
  const F rise = dot(next, at.frame.z);
  const Color kept = select(rise * wanted < F(0.0f), next - at.frame.z * (F(2.0f) * rise), next);
  paths.direction = select(paths.alive, kept, paths.direction);
  paths.inside = wanted < F(0.0f);
}

void harvest_leaving(const Environment& environment, Paths& paths, Harvest& harvest) {
  const Mask leaves = paths.alive && !paths.inside;
  if (any(leaves)) {
    harvest.add(environment.radiance(paths.direction), select(leaves, paths.throughput, F(0.0f)));
  }
  paths.alive = paths.alive && paths.inside;
}

// Straight on; the radiance inside is that outside times the square of the index.
void harvest_trapped(const GlassBody& body, const Paths& paths, Harvest& harvest) {
  const F throughput = select(paths.alive, paths.throughput * body.ior * body.ior, F(0.0f));
  harvest.add(body.environment.radiance(paths.direction), throughput);
  harvest.trapped += throughput;
}

// The other end of a chord through the unit ball.
Color across(const Color& position, const Color& direction) {
  return normalize(position - direction * (F(2.0f) * dot(position, direction)));
}

// The boundary at the other end of a chord of the ball; of the slab, its other face.
Boundary next_boundary(const GlassBody& body, const Boundary& first, int bounce, Paths& paths) {
  if (!body.picture.is_ball()) return bounce % 2 == 0 ? back_of(first) : first;
  paths.position = across(paths.position, paths.direction);
  TexelBlock<F> block;
  Frame<F> frame;
  body.picture.fill_on_ball(paths.position, block, frame);
  return boundary_of(block, frame);
}

void trace(const GlassBody& body, const Boundary& first, Paths paths,
           const std::array<std::uint32_t, 4>& point, const std::array<WideUint, 4>& seeds,
           int index, Harvest& harvest) {
  Boundary at = first;
  for (int bounce = 0; bounce < most_bounces; ++bounce) {
    meet(body, at, draw(point, seeds, index, bounce), paths);
    harvest_leaving(body.environment, paths, harvest);
    if (!any(paths.alive)) return;
    at = next_boundary(body, first, bounce, paths);
  }
  harvest_trapped(body, paths, harvest);
}

struct GlassRenderer {
  const GlassBody& body;
  const SobolPoints& points;
  int seed;
  Plane &carried, &trapped;

  void add(int x, int y, const PointRange& range, PixelSums& sums) const {
    const WideUint texels = texel_hashes(x, body.picture.first_row() + y, seed);
    const int share = (range.last - range.first) / body.picture.positions();
    for (int position = 0; position < body.picture.positions(); ++position) {
      TexelBlock<F> block;
      Placement<F> placement;
      body.picture.fill<F>(x, y, position, block, placement);
      const Boundary first = boundary_of(block, placement.frame);
      const Paths start{placement.frame.z, -placement.to_viewer, F(1.0f), Mask(true), Mask(false)};
      const int begin = range.first + position * share;
      for (std::uint32_t r = 0; r < repetitions; ++r) {
        const auto seeds = repetition_seeds<WideUint>(texels, r);
        Harvest harvest;
        for (int i = begin; i < begin + share; ++i) {
          trace(body, first, start, points[static_cast<size_t>(i)], seeds, i, harvest);
        }
        sums.light[r] += harvest.radiance;
        sums.carried += harvest.carried;
        sums.trapped += harvest.trapped;
      }
    }
  }
  void finish(int x, int y, const PixelSums& sums, int count) const {
    const F scale(1.0f / static_cast<float>(repetitions * count));
    store_lanes(carried.row(y) + x, sums.carried * scale);
    store_lanes(trapped.row(y) + x, sums.trapped * scale);
  }
};

}  // namespace

GlassPicture estimate_glass(const Picture& picture, const ShadingInputs& inputs,
                            const SamplePlan& plan) {
  GlassPicture made{make_sampled_image(picture), Plane(picture.size()), Plane(picture.size())};
  Layers& image = made.image;
  const GlassAlbedos albedos(inputs.surface.ior);
  const Sampling sampling{plan.samples / repetitions, plan.most / repetitions, plan.target_error,
                          plan.seed};
  const SobolPoints points =
      sobol_points_reversed(plan.target_error > 0 ? sampling.most : sampling.points);
  const GlassBody body{picture, *inputs.light->environment,
                       F(static_cast<float>(inputs.surface.ior)),
                       inputs.surface.energy == "none" ? nullptr : &albedos};
  sample_blocks(GlassRenderer{body, points, plan.seed, made.carried, made.trapped}, sampling,
                image);
  scale_plane(image.layers[points_plane].plane, repetitions);
  clear_background(picture, image);
  return made;
}

}  // namespace kiln
