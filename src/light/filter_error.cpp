// SPDX-License-Identifier: Apache-2.0
#include "kiln/light/filter_error.h"

#include <algorithm>
#include <cmath>

#include "kiln/math/hash.h"

namespace kiln {
namespace {

// Of large sources fewer, so that checking does not take longer than filtering.
std::uint32_t spread_texels(Size source) {
  constexpr long long budget = 10LL * 1024 * 512;
  return static_cast<std::uint32_t>(std::clamp(budget / area(source), 1LL, 10LL));
}

// Wider lobes are so smooth that the texel beside another says nothing new.
constexpr double widest_of_edges = 0.25;

struct TexelAt {
  int image, x, y;
};

// Texels spread over all images by a hash, the same for every run.
std::vector<TexelAt> spread_over(const FilteredLevel& level, std::uint32_t count) {
  const Size size = level.images.front().size;
  const auto pick = [](std::uint32_t number, int below) {
    return static_cast<int>(mix_bits(number) % static_cast<std::uint32_t>(below));
  };
  std::vector<TexelAt> texels;
  for (std::uint32_t i = 0; i < count; ++i) {
    texels.push_back({static_cast<int>(i % level.images.size()), pick(2 * i, size.width),
                      pick(2 * i + 1, size.height)});
  }
  return texels;
}

TexelAt brightest_of(const FilteredLevel& level) {
  TexelAt best{0, 0, 0};
  float most = -INFINITY;
  for (size_t image = 0; image < level.images.size(); ++image) {
    const Plane& green = level.images[image].layers[1].plane;
    for (int y = 0; y < green.height(); ++y) {
      for (int x = 0; x < green.width(); ++x) {
        if (green.at(x, y) <= most) continue;
        most = green.at(x, y);
        best = {static_cast<int>(image), x, y};
      }
    }
  }
  return best;
}

std::vector<TexelAt> choose_texels(const FilteredLevel& level, std::uint32_t spread) {
  std::vector<TexelAt> texels = spread_over(level, spread);
  const TexelAt best = brightest_of(level);
  const Size size = level.images.front().size;
  texels.push_back(best);
  if (level.lobe.alpha > widest_of_edges) return texels;
  texels.push_back({best.image, best.x > 0 ? best.x - 1 : std::min(1, size.width - 1), best.y});
  return texels;
}

}  // namespace

std::vector<FilterError> filter_errors(const Prefilter& prefilter,
                                       const std::vector<FilteredLevel>& levels,
                                       double mean_radiance) {
  const std::uint32_t spread = spread_texels(prefilter.source_size());
  std::vector<LobeProbe> probes;
  std::vector<std::vector<TexelAt>> texels;
  for (const FilteredLevel& level : levels) {
    texels.push_back(choose_texels(level, spread));
    probes.push_back({level.lobe, {}});
    for (const TexelAt& at : texels.back()) {
      probes.back().directions.push_back(level.grid.direction(at.image, at.x, at.y));
    }
  }
  const auto truth = prefilter.brute_force(probes);
  const double scale = 1 / std::max(std::abs(mean_radiance), 1e-30);
  std::vector<FilterError> errors(levels.size());
  for (size_t l = 0; l < levels.size(); ++l) {
    double squares = 0;
    for (size_t i = 0; i < texels[l].size(); ++i) {
      const TexelAt& at = texels[l][i];
      const auto& layers = levels[l].images[static_cast<size_t>(at.image)].layers;
      const Vec3<double> found{layers[0].plane.at(at.x, at.y), layers[1].plane.at(at.x, at.y),
                               layers[2].plane.at(at.x, at.y)};
      const Vec3<double> apart = (found - truth[l][i]) * scale;
      squares += dot(apart, apart) / 3;
      errors[l].max =
          std::max({errors[l].max, std::abs(apart.x), std::abs(apart.y), std::abs(apart.z)});
    }
    errors[l].rms = std::sqrt(squares / static_cast<double>(texels[l].size()));
  }
  return errors;
}

}  // namespace kiln
