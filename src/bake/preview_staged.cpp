// SPDX-License-Identifier: Apache-2.0
#include "preview_staged.h"

namespace kiln {
namespace {

using F = WideFloat;

DirectionTerms average_terms(const AlbedoTable& table, const AlbedoRow<F>& row) {
  return {table.average(row), table.average_edge(row)};
}

// As in the fused loop: the lobe's share of what is reflected, never without the other.
void set_specular_share(StagedPoint& point) {
  const F left = max(F(1.0f) - max_component(point.total_o), F(0.0f));
  const F more = max(luminance(point.total_o - point.single_o), F(0.0f));
  const F spread = more + luminance(point.diffuse_color) * left;
  const F lobe = luminance(point.single_o);
  point.specular_share = clamp(lobe / max(lobe + spread, F(1e-6f)), F(0.1f), F(0.9f));
}

// One direction from the texel's own density; it may lie below the horizon.
WideVec sample_direction(const StagedPoint& point, const SurfaceStages& stages, const Vec2<F>& u) {
  const F share = point.specular_share;
  const auto specular = u.x < share;
  const F x = select(specular, u.x / share, (u.x - share) / (F(1.0f) - share));
  const Vec2<F> v{min(x, F(1 - 0x1p-24f)), u.y};
  const WideVec wm = stages.sample_normal(point, v);
  const WideVec mirrored = wm * (F(2.0f) * dot(point.wo, wm)) - point.wo;
  return select(specular, mirrored, square_to_cosine(v));
}

void append(DirectionBlock& block, WideVec wi, const WideVec& radiance, F light_density) {
  const auto above = wi.z > F(1e-6f);
  const int i = block.count++;
  block.reached[i] = select(above, wi.z, F(0.0f));
  wi.z = max(wi.z, F(1e-6f));
  block.wi[i] = wi;
  block.light[i] = radiance;
  block.light_density[i] = light_density;
}

// One direction from the environment and one from the texel.
void append_pair(const StagedPoint& point, const LightControl<F>& control,
                 const SurfaceStages& stages, const Environment& environment,
                 const std::array<F, 4>& u, DirectionBlock& block) {
  const LightSample<F> light = environment.sample(Vec2<F>{u[0], u[1]});
  const WideVec toward = point.frame.to_local(light.direction);
  block.known[block.count] = control.toward(toward);
  append(block, toward, light.radiance, light.density);
  const WideVec wi = sample_direction(point, stages, {u[2], u[3]});
  const Arriving<F> own = environment.arriving(point.frame.to_world(wi));
  block.known[block.count] = control.toward(wi);
  append(block, wi, select(wi.z > F(1e-6f), own.radiance, WideVec{F(0.0f), F(0.0f), F(0.0f)}),
         own.density);
}

void look_up(const StagedPoint& point, const AlbedoTable& table, DirectionBlock& block) {
  for (int i = 0; i < block.count; ++i) {
    const F mu = block.wi[i].z;
    block.terms[i] = {table.terms(point.row, mu), table.edge(point.row, mu)};
  }
}

void run_stages(const StagedPoint& point, const SurfaceStages& stages, const AlbedoTable& table,
                DirectionBlock& block) {
  stages.add_lobe(point, block);
  look_up(point, table, block);
  stages.add_fresnel(point, block);
  stages.add_energy(point, block);
  stages.add_diffuse(point, block);
  stages.couple(point, block);
}

// (f cos - g) L / (p_e + p_b) of one direction of a block.
WideVec weigh_light(const StagedPoint& point, const DirectionBlock& block, int i) {
  const F cosine = block.reached[i];
  const F own_density = select(cosine > F(0.0f), block.own_density[i], F(0.0f));
  const WideVec reflected =
      (block.specular[i] + block.diffuse[i] * point.occlusion) * cosine - block.known[i];
  return reflected * block.light[i] * (F(1.0f) / (own_density + block.light_density[i]));
}

}  // namespace

StagedPoint make_staged_point(const TexelValues<F>& texel, const Placement<F>& placement,
                              const AlbedoTable& table, const SurfaceStages& stages) {
  StagedPoint point;
  point.roughness = clamp(texel.roughness, F(0.0f), F(1.0f));
  point.shape = stages.shape;
  point.occlusion = texel.occlusion;
  point.diffuse_color = texel.diffuse_color;
  const WideVec normal = bend_toward(placement.frame.to_world(texel.normal), placement.to_viewer);
  const LobeFrame<F> lobe = lobe_frame(placement.frame, normal, texel, point.roughness);
  point.frame = lobe.frame;
  point.alpha_x = lobe.alpha_x;
  point.alpha_y = lobe.alpha_y;
  point.wo = point.frame.to_local(placement.to_viewer);
  point.wo.z = max(point.wo.z, F(1e-3f));
  point.row = table.row(lobe.table_roughness);
  point.terms_o = {table.terms(point.row, point.wo.z), table.edge(point.row, point.wo.z)};
  point.average = average_terms(table, point.row);
  point.bounded_average = table.average_bounded(point.row);
  stages.set_fresnel(stages.numbers, texel.f0, point);
  stages.set_energy(point);
  set_specular_share(point);
  return point;
}

// Directions of all repetitions fill blocks together, so that few points fill them too.
void add_points(const StagedPoint& point, const LightControl<F>& control,
                const SurfaceStages& stages, const Environment& environment,
                const AlbedoTable& table, const ScrambledPoints& points, RepetitionSums& sums) {
  const WideVec known = control.light() * F(static_cast<float>(points.last - points.first));
  std::array<size_t, DirectionBlock::capacity> repetition;
  DirectionBlock block;
  const auto add_block = [&] {
    run_stages(point, stages, table, block);
    for (int i = 0; i < block.count; ++i) {
      sums[repetition[static_cast<size_t>(i)]] += weigh_light(point, block, i);
    }
    block.count = 0;
  };
  for (size_t r = 0; r < sums.size(); ++r) {
    sums[r] += known;
    const auto seeds = repetition_seeds<WideUint>(points.texels, static_cast<std::uint32_t>(r));
    for (int i = points.first; i < points.last; ++i) {
      const auto at = static_cast<size_t>(block.count);
      repetition[at] = repetition[at + 1] = r;
      append_pair(point, control, stages, environment, scrambled<F>(points.set[i], seeds), block);
      if (block.count == DirectionBlock::capacity) add_block();
    }
  }
  if (block.count > 0) add_block();
}

WideVec diffuse_reflectance(const StagedPoint& point, const SurfaceStages& stages) {
  const F left = clamp(F(1.0f) - max_component(point.total_o), F(0.0f), F(1.0f));
  return stages.diffuse_albedo(point) * left * point.occlusion;
}

WideVec reflect_distant(const StagedPoint& point, const SurfaceStages& stages,
                        const AlbedoTable& table, const WideVec& toward,
                        const WideVec& irradiance) {
  DirectionBlock block;
  append(block, point.frame.to_local(toward), irradiance, F(0.0f));
  run_stages(point, stages, table, block);
  return (block.specular[0] + block.diffuse[0]) * block.light[0] * block.reached[0];
}

WideVec approximate(const StagedPoint& point, const SurfaceStages& stages, const Light& light) {
  const WideVec mirrored =
      engine_direction(point.wo, point.alpha_x, point.alpha_y, point.roughness);
  const WideVec diffuse = diffuse_reflectance(point, stages);
  const WideVec specular = light.chain->lookup(point.frame.to_world(mirrored), point.roughness);
  return specular * point.total_o + light.irradiance->lookup(point.frame.z) * diffuse;
}

}  // namespace kiln
