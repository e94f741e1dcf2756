// SPDX-License-Identifier: Apache-2.0
#include "kiln/light/chain_error.h"

#include <array>
#include <cmath>

#include "color_planes.h"
#include "kiln/image/projection.h"
#include "kiln/light/irradiance.h"
#include "kiln/math/hash.h"
#include "kiln/parallel/rows.h"
#include "prefilter.h"
#include "zonal_kernel.h"

namespace kiln {
namespace {

constexpr int probes = 24;

struct Probe {
  Vec3<double> direction;
  Vec3<double> value;  // what the chain holds there
};

// Texels spread over all faces by a hash, the same for every run.
std::vector<Probe> choose_probes(const SpecularChain& chain, int level) {
  const int edge = chain.size(level);
  std::array<Layers, 6> faces;
  for (int f = 0; f < 6; ++f) faces[f] = chain.face(level, static_cast<CubeFace>(f));
  std::vector<Probe> chosen;
  for (std::uint32_t i = 0; i < probes; ++i) {
    const auto face = static_cast<int>(i % 6);
    const auto x = static_cast<int>(mix_bits(2 * i) % static_cast<std::uint32_t>(edge));
    const auto y = static_cast<int>(mix_bits(2 * i + 1) % static_cast<std::uint32_t>(edge));
    const Vec2<double> uv{(x + 0.5) / edge, (y + 0.5) / edge};
    const auto& layers = faces[face].layers;
    chosen.push_back(
        {normalize(cube_to_direction(static_cast<CubeFace>(face), uv)),
         {layers[0].plane.at(x, y), layers[1].plane.at(x, y), layers[2].plane.at(x, y)}});
  }
  return chosen;
}

// Adds the texels of one row to the sums of every probe: [probe]{R, G, B, weight}.
void add_row(const ColorPlanes& latlong, int y, double alpha2, const std::vector<Probe>& chosen,
             std::vector<double>& sums) {
  const double solid_angle = latlong_texel_solid_angle(latlong.size, y);
  for (int x = 0; x < latlong.size.width; ++x) {
    const Vec2<double> uv{(x + 0.5) / latlong.size.width, (y + 0.5) / latlong.size.height};
    const Vec3<double> w = latlong_to_direction(uv);
    const Vec3<double> radiance = latlong.at(x, y);
    for (size_t p = 0; p < chosen.size(); ++p) {
      const Vec3<double> apart = chosen[p].direction - w;
      const double weight = ggx_lobe(dot(apart, apart) / 4, alpha2) * solid_angle;
      sums[4 * p] += weight * radiance.x;
      sums[4 * p + 1] += weight * radiance.y;
      sums[4 * p + 2] += weight * radiance.z;
      sums[4 * p + 3] += weight;
    }
  }
}

// The source as it is filtered: made finer where the sharpest lobe needs it.
Layers filtered_source(const Layers& latlong, const SpecularChain& chain) {
  std::vector<FilteredLevel> levels;
  for (int level = 1; level < chain.levels(); ++level) {
    levels.push_back({chain.size(level), square(chain.roughness(level))});
  }
  return finer(latlong, refinement_for(latlong.size, levels));
}

double level_error(const ColorPlanes& latlong, const SpecularChain& chain, int level) {
  const std::vector<Probe> chosen = choose_probes(chain, level);
  const double alpha = chain.roughness(level) * chain.roughness(level);
  const auto sums = sum_rows(latlong.size.height, 4 * probes, [&](int y, std::vector<double>& row) {
    add_row(latlong, y, alpha * alpha, chosen, row);
  });
  double squares = 0;
  for (size_t p = 0; p < chosen.size(); ++p) {
    const Vec3<double> truth =
        Vec3<double>{sums[4 * p], sums[4 * p + 1], sums[4 * p + 2]} * (1 / sums[4 * p + 3]);
    const Vec3<double> error = chosen[p].value - truth;
    squares += dot(error, error) / 3;
  }
  return std::sqrt(squares / static_cast<double>(chosen.size()));
}

}  // namespace

std::vector<double> chain_errors(const Layers& latlong, const SpecularChain& chain) {
  const double mean = std::max(std::abs(luminance(mean_radiance(latlong))), 1e-30);
  std::vector<double> errors(static_cast<size_t>(chain.levels()));
  if (chain.levels() == 1) return errors;
  const Layers source = filtered_source(latlong, chain);
  for (int level = 1; level < chain.levels(); ++level) {
    errors[static_cast<size_t>(level)] = level_error(color_planes(source), chain, level) / mean;
  }
  return errors;
}

}  // namespace kiln
