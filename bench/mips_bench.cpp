// SPDX-License-Identifier: Apache-2.0
// How long it takes to make roughness mips of a normal map, once it is read, with each method:
// medians.
//
//   bench_mips NORMAL_MAP [ROUGHNESS] [RUNS]
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <functional>
#include <vector>

#include "kiln/image/mip_levels.h"
#include "kiln/io/image_file.h"
#include "kiln/material/normal_filter.h"
#include "kiln/material/normals.h"
#include "kiln/parallel/rows.h"
#include "kiln/parallel/stages.h"

namespace {

using namespace kiln;

constexpr int rows_of_band = 64;

double median_ms(int runs, const std::function<void()>& work) {
  std::vector<double> times;
  for (int i = 0; i < runs; ++i) {
    const auto start = std::chrono::steady_clock::now();
    work();
    const std::chrono::duration<double, std::milli> taken =
        std::chrono::steady_clock::now() - start;
    times.push_back(taken.count());
  }
  std::sort(times.begin(), times.end());
  return times[times.size() / 2];
}

Layers rows_of(const Layers& image, int first, int rows) {
  Layers band{{image.size.width, rows}, {}};
  for (const Layer& layer : image.layers) {
    Plane& plane = band.add(layer.name);
    for (int y = 0; y < rows; ++y) {
      const auto row = layer.plane.texels_of_row(first + y);
      std::copy(row.begin(), row.end(), plane.row(y));
    }
  }
  return band;
}

// From stored numbers to the roughness of all levels, as the bake does it.
void make_levels(const Layers& stored, float roughness, NormalFilter method) {
  const std::vector<Size> sizes = level_sizes(stored.size);
  const NormalDecoding decoding{.range = NormalRange::Unsigned,
                                .layout = NormalLayout::ThreeChannel};
  MipCascade cascade(sizes, moment_count(method));
  const Plane constant({stored.size.width, 1}, roughness);
  const auto filter = [&](const DecodedNormals& band, int first) {
    const auto made = cascade.add(band.normal[0].height(), [&](int y, float* const* moments) {
      const int row = y - first;
      fill_moments(method,
                   {stored.size.width,
                    constant.row(0),
                    {band.normal[0].row(row), band.normal[1].row(row), band.normal[2].row(row)}},
                   moments);
    });
    for (const LevelRows& rows : made) {
      Plane level({rows.planes.front().width(), rows.rows()});
      for_rows(rows.rows(), [&](int y) {
        std::vector<const float*> moments;
        for (const Plane& plane : rows.planes) moments.push_back(plane.row(y));
        LobeRow lobes;
        lobes.roughness = level.row(y);
        lobes_of_moments({.method = method}, level.width(), moments.data(), lobes);
      });
    }
  };
  const int height = stored.size.height;
  struct Band {
    int first = 0;
    DecodedNormals normals;
  };
  run_stages<Band>((height + rows_of_band - 1) / rows_of_band, 4,
                   [&](int i) {
                     return Band{i * rows_of_band, {}};
                   },
                   [&](int, Band& band) {
                     const int rows = std::min(rows_of_band, height - band.first);
                     band.normals = decode_normals(rows_of(stored, band.first, rows), decoding);
                   },
                   [&](int, Band& band) { filter(band.normals, band.first); });
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) return 2;
  const float roughness = argc > 2 ? std::strtof(argv[2], nullptr) : 0.3f;
  const int runs = argc > 3 ? std::atoi(argv[3]) : 5;
  Layers stored;
  fmt::print("reading {:.1f}\n",
             median_ms(std::min(runs, 3), [&] { stored = read_image(argv[1]).image; }));
  for (const NormalFilter method : {NormalFilter::Toksvig, NormalFilter::Vmf, NormalFilter::Lean}) {
    fmt::print("computing {} {:.1f}\n", normal_filter_names[static_cast<size_t>(method)],
               median_ms(runs, [&] { make_levels(stored, roughness, method); }));
  }
}
