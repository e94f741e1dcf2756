// SPDX-License-Identifier: Apache-2.0
#include "mip_filter.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "kiln/material/normals.h"
#include "kiln/math/hash.h"
#include "kiln/parallel/rows.h"

namespace kiln {
namespace {

constexpr int judged_levels = 5;   // below the first: footprints of up to 32 x 32 texels
constexpr int judged_texels = 16;  // of each
constexpr int half_vectors = 512;

std::vector<const float*> rows_of(const std::vector<Plane>& planes, int y) {
  std::vector<const float*> rows;
  rows.reserve(planes.size());
  for (const Plane& plane : planes) rows.push_back(plane.row(y));
  return rows;
}

std::vector<float*> rows_of(Layers& image, int y) {
  std::vector<float*> rows;
  rows.reserve(image.layers.size());
  for (Layer& layer : image.layers) rows.push_back(layer.plane.row(y));
  return rows;
}

// The energy of rows, each by itself, summed in their order.
double energy_of_first(const MipMap& map, const MipBand& band, Layers& image) {
  std::vector<double> sums(static_cast<size_t>(band.rows));
  for_rows(band.rows, [&](int y) {
    const std::vector<float*> layers = rows_of(image, y);
    const int width = image.size.width;
    if (!map.energy_of_numbers) {
      sums[static_cast<size_t>(y)] = map.energy(width, nullptr, layers.data());
      return;
    }
    std::vector<Plane> numbers(static_cast<size_t>(map.channels), Plane({width, 1}));
    std::vector<float*> filled;
    filled.reserve(numbers.size());
    for (Plane& plane : numbers) filled.push_back(plane.row(0));
    map.fill(band, y, filled.data());
    sums[static_cast<size_t>(y)] = map.energy(width, filled.data(), layers.data());
  });
  return std::accumulate(sums.begin(), sums.end(), 0.0);
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// The texels of the first level below texel x of a level, and the normal of their mean slope.
Facets footprint_of(const MipBand& band, int x, int y, int edge, Vec3<float>& normal) {
  Facets facets;
  Vec3<float> sum;
  for (int j = y * edge; j < (y + 1) * edge; ++j) {
    for (int i = x * edge; i < (x + 1) * edge; ++i) {
      const Vec3<float> n{band.normal[0].at(i, j), band.normal[1].at(i, j),
                          band.normal[2].at(i, j)};
      facets.add(n, band.roughness.at(i, j));
      sum += n * (1.0f / std::max(n.z, least_normal_z));
    }
  }
  normal = normalize(sum);
  return facets;
}

}  // namespace

MipFilter::MipFilter(std::vector<MipMap> maps, const std::vector<Size>& sizes, int judged)
    : sizes_(sizes), judged_(judged), errors_(sizes.size()) {
  for (MipMap& map : maps) {
    const int channels = map.channels;
    maps_.push_back(
        {std::move(map), MipCascade(sizes, channels), std::vector<double>(sizes.size()), {}});
  }
}

std::vector<MipRows> MipFilter::add(const MipBand& band) {
  for_rows(static_cast<int>(maps_.size()), [&](int i) { add(band, static_cast<size_t>(i)); });
  std::vector<MipRows> all;
  for (size_t i = 0; i < maps_.size(); ++i) {
    if (static_cast<int>(i) == judged_) judge(band, maps_[i].made);
    std::move(maps_[i].made.begin(), maps_[i].made.end(), std::back_inserter(all));
    maps_[i].made.clear();
  }
  return all;
}

void MipFilter::add(const MipBand& band, size_t file) {
  InWork& work = maps_[file];
  MipRows first{file, 0, work.map.first_as_stored, work.map.first(band)};
  if (work.map.energy) work.energy[0] += energy_of_first(work.map, band, first.image);
  work.made.push_back(std::move(first));
  const auto fill = [&](int y, float* const* numbers) {
    work.map.fill(band, y - band.first, numbers);
  };
  for (const LevelRows& averages : work.cascade.add(band.rows, fill)) store(work, averages, file);
}

void MipFilter::store(InWork& work, const LevelRows& averages, size_t file) const {
  const Size size{sizes_[static_cast<size_t>(averages.level)].width, averages.rows()};
  MipRows rows{file, averages.level, false, make_layers(size, work.map.file.names)};
  std::vector<double> sums(static_cast<size_t>(size.height));
  for_rows(size.height, [&](int y) {
    const std::vector<const float*> numbers = rows_of(averages.planes, y);
    const std::vector<float*> layers = rows_of(rows.image, y);
    work.map.store(averages.level, size.width, numbers.data(), layers.data());
    if (work.map.energy) {
      sums[static_cast<size_t>(y)] = work.map.energy(size.width, numbers.data(), layers.data());
    }
  });
  work.energy[static_cast<size_t>(averages.level)] +=
      std::accumulate(sums.begin(), sums.end(), 0.0);
  work.made.push_back(std::move(rows));
}

// Texels whose footprint lies within the band, one at most of each level, so that they spread.
void MipFilter::judge(const MipBand& band, const std::vector<MipRows>& made) {
  for (const MipRows& rows : made) {
    const int edge = 1 << rows.level;
    std::vector<LobeError>& errors = errors_[static_cast<size_t>(rows.level)];
    const bool even = sizes_[0].width % edge == 0 && sizes_[0].height % edge == 0;
    if (rows.level == 0 || rows.level > judged_levels || !even || band.first % edge != 0 ||
        band.rows < edge || errors.size() == judged_texels) {
      continue;
    }
    const int bands = std::max(1, sizes_[0].height / std::max(1, band.rows));
    const uint32_t bits =
        combine_hash(static_cast<uint32_t>(band.first), static_cast<uint32_t>(rows.level));
    if (bits % static_cast<uint32_t>(bands) >= 2 * judged_texels) continue;
    const auto x = static_cast<int>(mix_bits(bits) % static_cast<uint32_t>(rows.image.size.width));
    const auto y =
        static_cast<int>(mix_bits(bits + 1) % static_cast<uint32_t>(rows.image.size.height));
    OneLobe lobe;
    const Facets facets = footprint_of(band, x, y, edge, lobe.normal);
    const float r = rows.image.layers[0].plane.at(x, y);
    lobe.alpha_x = lobe.alpha_y = r * r;
    errors.push_back(lobe_error(facets, lobe, half_vectors, bits));
  }
}

std::vector<std::pair<std::string, double>> MipFilter::figures() const {
  std::vector<std::pair<std::string, double>> figures;
  for (const InWork& work : maps_) {
    for (size_t l = 0; l < sizes_.size() && work.map.energy; ++l) {
      figures.emplace_back(
          fmt::format("{}, level {}: mean {}", work.map.file.name, l, work.map.energy_name),
          work.energy[l] / static_cast<double>(area(sizes_[l])));
    }
  }
  for (size_t l = 0; l < errors_.size(); ++l) {
    if (errors_[l].empty()) continue;
    std::vector<double> peaks, rms;
    for (const LobeError& error : errors_[l]) {
      peaks.push_back(error.peak);
      rms.push_back(error.rms);
    }
    const std::string of = fmt::format("lobes, level {}: ", l);
    figures.emplace_back(of + "error of the peak, median", median(peaks));
    figures.emplace_back(of + "rms error of the density, median", median(rms));
  }
  return figures;
}

}  // namespace kiln
