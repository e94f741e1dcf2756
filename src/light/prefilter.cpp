// SPDX-License-Identifier: Apache-2.0
#include "prefilter.h"

#include <algorithm>
#include <bit>

#include "harmonic_synthesis.h"
#include "kiln/image/projection.h"
#include "kiln/parallel/rows.h"

namespace kiln {
namespace {

// Energy that the cut of the expansion may neglect (as a root), and how far the error of a single
// texel may then reach, in units of the mean over the lobe's width.
constexpr double cut_off = 1e-4;
constexpr double hot_threshold = 2;
// Where sin(theta)^m would underflow to no good, see LegendreColumn.
constexpr int highest_order = 1800;

/// Texels taken out of the expansion, and added exactly: directions and radiance times solid angle.
/// Padded to whole wide numbers by texels without light.
struct HotTexels {
  std::vector<float> x, y, z;
  std::array<std::vector<float>, 3> power;

  void add(const Vec3<double>& direction, const Vec3<double>& light) {
    x.push_back(static_cast<float>(direction.x));
    y.push_back(static_cast<float>(direction.y));
    z.push_back(static_cast<float>(direction.z));
    power[0].push_back(static_cast<float>(light.x));
    power[1].push_back(static_cast<float>(light.y));
    power[2].push_back(static_cast<float>(light.z));
  }
  void pad() {
    while (x.size() % static_cast<size_t>(lane_count<WideFloat>) != 0) add({0, 1, 0}, {0, 0, 0});
  }
};

using Rows = std::vector<std::vector<double>>;  // [height][3 * width]

Rows rows_of(const Layers& latlong) {
  const ColorPlanes colors = color_planes(latlong);
  Rows rows(static_cast<size_t>(colors.size.height));
  for_rows(colors.size.height, [&](int y) {
    auto& row = rows[static_cast<size_t>(y)];
    for (int x = 0; x < colors.size.width; ++x) {
      const Vec3<double> value = colors.at(x, y);
      row.insert(row.end(), {value.x, value.y, value.z});
    }
  });
  return rows;
}

/// Sum of |radiance| times solid angle, by color.
std::array<double, 3> total_power(Size size, const Rows& rows) {
  const auto sums = sum_rows(size.height, 3, [&](int y, std::vector<double>& share) {
    const auto& row = rows[static_cast<size_t>(y)];
    for (size_t i = 0; i < row.size(); ++i) share[i % 3] += std::abs(row[i]);
    for (double& sum : share) sum *= latlong_texel_solid_angle(size, y);
  });
  return {sums[0], sums[1], sums[2]};
}

// A texel whose share of any colour's power exceeds the threshold would, through the cut of the
// expansion, ring visibly around itself. At most 3 / threshold texels do.
HotTexels take_out_hot(Size size, double threshold, Rows& rows) {
  const std::array<double, 3> total = total_power(size, rows);
  HotTexels hot;
  for (int y = 0; y < size.height; ++y) {
    const double solid_angle = latlong_texel_solid_angle(size, y);
    auto& row = rows[static_cast<size_t>(y)];
    for (int x = 0; x < size.width; ++x) {
      double* texel = row.data() + 3 * x;
      bool is_hot = false;
      for (size_t c = 0; c < 3; ++c) {
        is_hot = is_hot || std::abs(texel[c]) * solid_angle > threshold * total[c];
      }
      if (!is_hot) continue;
      const Vec2<double> uv{(x + 0.5) / size.width, (y + 0.5) / size.height};
      hot.add(latlong_to_direction(uv), Vec3<double>{texel[0], texel[1], texel[2]} * solid_angle);
      std::fill_n(texel, 3, 0.0);
    }
  }
  hot.pad();
  return hot;
}

Vec3<float> sum_hot(const HotTexels& hot, const Vec3<float>& d, float alpha2) {
  constexpr size_t lanes = lane_count<WideFloat>;
  std::array<WideFloat, 3> sums{WideFloat(0.0f), WideFloat(0.0f), WideFloat(0.0f)};
  for (size_t i = 0; i < hot.x.size(); i += lanes) {
    const WideFloat x = WideFloat(d.x) - load_lanes<WideFloat>(hot.x.data() + i);
    const WideFloat y = WideFloat(d.y) - load_lanes<WideFloat>(hot.y.data() + i);
    const WideFloat z = WideFloat(d.z) - load_lanes<WideFloat>(hot.z.data() + i);
    const WideFloat s = WideFloat(0.25f) * fma(x, x, fma(y, y, z * z));
    const WideFloat lobe = ggx_lobe(s, WideFloat(alpha2));
    for (size_t c = 0; c < 3; ++c) {
      sums[c] = fma(lobe, load_lanes<WideFloat>(hot.power[c].data() + i), sums[c]);
    }
  }
  return {xsimd::hadd(sums[0]), xsimd::hadd(sums[1]), xsimd::hadd(sums[2])};
}

Vec3<double> cube_texel_direction(int size, int index) {
  const int face = index / (size * size), y = index / size % size, x = index % size;
  const Vec2<double> uv{(x + 0.5) / size, (y + 0.5) / size};
  return normalize(cube_to_direction(static_cast<CubeFace>(face), uv));
}

/// The expansion's share, the hot texels' share, over what the constant 1 gives.
CubeTexels filter_level(const Expansion& expansion, const HotTexels& hot, const ZonalKernel& kernel,
                        int size) {
  const SphereField field = convolve(expansion, kernel);
  CubeTexels texels(static_cast<size_t>(6 * size * size));
  const auto alpha2 = static_cast<float>(kernel.alpha * kernel.alpha);
  const auto scale = static_cast<float>(1 / kernel.integral);
  for_rows(6 * size, [&](int row) {
    for (int i = row * size; i < (row + 1) * size; ++i) {
      const Vec3<double> d = cube_texel_direction(size, i);
      const std::array<float, 4> smooth = field.at(d);
      const Vec3<float> near{static_cast<float>(d.x), static_cast<float>(d.y),
                             static_cast<float>(d.z)};
      const Vec3<float> sum =
          Vec3<float>{smooth[0], smooth[1], smooth[2]} + sum_hot(hot, near, alpha2) * scale;
      texels[static_cast<size_t>(i)] = {sum.x / smooth[3], sum.y / smooth[3], sum.z / smooth[3]};
    }
  });
  return texels;
}

/// Zero where a source without negative radiance came out below zero by rounding and the cut.
void clip_undershoot(const Rows& rows, CubeTexels& texels) {
  std::array<double, 3> lowest{};
  for (const auto& row : rows) {
    for (size_t i = 0; i < row.size(); ++i) lowest[i % 3] = std::min(lowest[i % 3], row[i]);
  }
  const Vec3<bool> never{lowest[0] >= 0, lowest[1] >= 0, lowest[2] >= 0};
  for (Vec3<float>& texel : texels) {
    if (never.x) texel.x = std::max(texel.x, 0.0f);
    if (never.y) texel.y = std::max(texel.y, 0.0f);
    if (never.z) texel.z = std::max(texel.z, 0.0f);
  }
}

int times_finer(int found, int needed) {
  const auto times = static_cast<unsigned>((needed + found - 1) / found);
  return static_cast<int>(std::bit_ceil(std::max(times, 1u)));
}

std::vector<ZonalKernel> expand_lobes(const std::vector<FilteredLevel>& levels) {
  std::vector<ZonalKernel> kernels;
  kernels.reserve(levels.size());
  for (const FilteredLevel& level : levels) {
    kernels.push_back(expand_ggx_lobe(level.alpha, cut_off, highest_order));
  }
  return kernels;
}

int highest_of(const std::vector<ZonalKernel>& kernels) {
  int order = 0;
  for (const ZonalKernel& kernel : kernels) order = std::max(order, kernel.order());
  return order;
}

double sharpest_of(const std::vector<FilteredLevel>& levels) {
  double alpha = 1;
  for (const FilteredLevel& level : levels) alpha = std::min(alpha, level.alpha);
  return alpha;
}

Refinement refinement_for(Size source, const std::vector<ZonalKernel>& kernels, double sharpest) {
  // Bands that the lobe itself needs, without the edge that all lobes have at the horizon.
  const int order = highest_of(kernels);
  const int bands = std::min(order, static_cast<int>(6 / sharpest)) + 1;
  return {times_finer(source.width, std::max(2 * bands, order + 1)),
          times_finer(source.height, bands)};
}

}  // namespace

Refinement refinement_for(Size source, const std::vector<FilteredLevel>& levels) {
  return refinement_for(source, expand_lobes(levels), sharpest_of(levels));
}

std::vector<CubeTexels> prefilter(const Layers& latlong, const std::vector<FilteredLevel>& levels) {
  const std::vector<ZonalKernel> kernels = expand_lobes(levels);
  const double sharpest = sharpest_of(levels);
  const Refinement times = refinement_for(latlong.size, kernels, sharpest);
  const Layers finer_source = times.across * times.down > 1 ? finer(latlong, times) : Layers{};
  const Layers& source = finer_source.layers.empty() ? latlong : finer_source;

  Rows rows = rows_of(source);
  const HotTexels hot = take_out_hot(source.size, hot_threshold * sharpest * sharpest, rows);
  const Expansion expansion = analyse(source.size, rows, highest_of(kernels));
  std::vector<CubeTexels> result;
  for (size_t i = 0; i < levels.size(); ++i) {
    result.push_back(filter_level(expansion, hot, kernels[i], levels[i].size));
    clip_undershoot(rows, result.back());
  }
  return result;
}

}  // namespace kiln
