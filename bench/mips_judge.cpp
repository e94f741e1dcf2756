// SPDX-License-Identifier: Apache-2.0
// How well each way of filtering normals into roughness stands for its footprint, by brute force:
// the GGX lobes of all texels of the first level below a texel, averaged, against the one lobe.
//
// Median and 90th percentile over texels chosen by a hash; of the peak with its sign too.
//
//   mips_judge NORMAL_MAP gl|dx ROUGHNESS_MAP|NUMBER [TEXELS_PER_LEVEL [LEVELS]]
//
// LEVELS is the beginning of the names of somebody's roughness levels, as images: LEVELS_1.png ...
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include "kiln/image/mip_levels.h"
#include "kiln/image/resample.h"
#include "kiln/io/image_file.h"
#include "kiln/material/lobe_error.h"
#include "kiln/material/normal_filter.h"
#include "kiln/material/normals.h"
#include "kiln/math/hash.h"
#include "kiln/table/albedo_table.h"

namespace {

using namespace kiln;

struct Surface {
  std::array<Plane, 3> normal;
  Plane roughness;
};

struct Level {
  Plane roughness, alpha_x, alpha_y, angle;
};

Surface read(const std::string& normals, const std::string& convention,
             const std::string& roughness) {
  NormalDecoding decoding;
  if (convention == "dx") decoding.convention = NormalConvention::DirectX;
  Surface surface;
  surface.normal = decode_normals(read_image(normals).image, decoding).normal;
  const Size size = surface.normal[0].size();
  char* end = nullptr;
  const float number = std::strtof(roughness.c_str(), &end);
  if (*end == '\0') {
    surface.roughness = Plane(size, number);
  } else {
    const Layers image = read_image(roughness).image;
    surface.roughness = resample(image.layers[image.layers.size() > 1 ? 1 : 0].plane, size);
  }
  return surface;
}

std::vector<Level> levels_of(const Surface& surface, const NormalFiltering& filtering, int count) {
  const std::vector<Size> sizes = level_sizes(surface.roughness.size(), count);
  MipCascade cascade(sizes, moment_count(filtering.method));
  std::vector<Level> levels(sizes.size());
  const auto made = cascade.add(sizes[0].height, [&](int y, float* const* moments) {
    fill_moments(filtering.method,
                 {sizes[0].width,
                  surface.roughness.row(y),
                  {surface.normal[0].row(y), surface.normal[1].row(y), surface.normal[2].row(y)}},
                 moments);
  });
  for (const LevelRows& rows : made) {
    Level& level = levels[rows.level];
    for (Plane* plane : {&level.roughness, &level.alpha_x, &level.alpha_y, &level.angle})
      *plane = Plane(sizes[rows.level]);
    for (int y = 0; y < rows.rows(); ++y) {
      std::vector<const float*> moments;
      for (const Plane& plane : rows.planes) moments.push_back(plane.row(y));
      lobes_of_moments(
          filtering, level.roughness.width(), moments.data(),
          {level.roughness.row(y), level.alpha_x.row(y), level.alpha_y.row(y), level.angle.row(y)});
    }
  }
  return levels;
}

std::vector<Level> read_levels(const std::string& stem, int count) {
  std::vector<Level> levels(1);
  for (int l = 1; l < count; ++l) {
    const Plane roughness = read_image(fmt::format("{}_{}.png", stem, l)).image.layers[0].plane;
    levels.push_back({roughness, roughness, roughness, roughness});
  }
  return levels;
}

struct Footprint {
  Facets facets;
  Vec3<float> normal;  ///< of the mean slope, or the mean
};

Footprint footprint_of(const Surface& surface, int x, int y, int edge, bool slopes) {
  Footprint footprint;
  Vec3<float> sum;
  for (int j = y * edge; j < (y + 1) * edge; ++j) {
    for (int i = x * edge; i < (x + 1) * edge; ++i) {
      const Vec3<float> n{surface.normal[0].at(i, j), surface.normal[1].at(i, j),
                          surface.normal[2].at(i, j)};
      footprint.facets.add(n, surface.roughness.at(i, j));
      sum += slopes ? n * (1.0f / std::max(n.z, least_normal_z)) : n;
    }
  }
  footprint.normal = normalize(sum);
  return footprint;
}

double albedo_error(const AlbedoTable& table, const Footprint& footprint, float roughness) {
  double greatest = 0;
  for (const float theta : {0.0f, 0.7f, 1.3f}) {
    for (int k = 0; k < (theta > 0 ? 4 : 1); ++k) {
      const float phi = static_cast<float>(pi) * 0.5f * static_cast<float>(k);
      const Vec3<float> o{std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                          std::cos(theta)};
      double mean = 0;
      const Facets& f = footprint.facets;
      for (int i = 0; i < f.count(); ++i) {
        const float mu = std::max(0.02f, dot(o, Vec3<float>{f.x[i], f.y[i], f.z[i]}));
        const auto terms = table.terms(table.row(std::sqrt(f.alpha[i])), mu);
        mean += terms.scale + terms.bias;
      }
      mean /= f.count();
      const auto one = table.terms(table.row(roughness), std::max(0.02f, dot(o, footprint.normal)));
      greatest = std::max(greatest, std::abs(one.scale + one.bias - mean));
    }
  }
  return greatest;
}

double quantile(std::vector<double>& values, double q) {
  std::sort(values.begin(), values.end());
  return values[static_cast<size_t>(q * static_cast<double>(values.size() - 1))];
}

struct Method {
  std::string name;
  NormalFiltering filtering;
  bool anisotropic = false, slopes = true;
};

}  // namespace

int main(int argc, char** argv) {
  if (argc < 4) return 2;
  const Surface surface = read(argv[1], argv[2], argv[3]);
  const int texels = argc > 4 ? std::atoi(argv[4]) : 200;
  const AlbedoTable table = AlbedoTable::build();
  std::vector<Method> methods{{"none", {NormalFilter::None}, false, true},
                              {"toksvig", {NormalFilter::Toksvig}, false, true},
                              {"vmf", {NormalFilter::Vmf}, false, true},
                              {"lean", {NormalFilter::Lean}, false, true},
                              {"lean, x and y", {NormalFilter::Lean}, true, true}};
  fmt::print("{:12} {:>5}   {:>8} {:>8} {:>8}   {:>8} {:>8}   {:>8}\n", "method", "level", "peak",
             "|peak|", "90 %", "rms", "90 %", "albedo");
  if (argc > 5) methods.push_back({"theirs", {NormalFilter::None}, false, true});
  for (const Method& method : methods) {
    const std::vector<Level> levels =
        method.name == "theirs" ? read_levels(argv[5], 6) : levels_of(surface, method.filtering, 6);
    for (int l = 1; l <= 5; l += 2) {
      std::vector<double> peaks, signed_peaks, rms, albedos;
      const Level& level = levels[l];
      for (int t = 0; t < texels; ++t) {
        const uint32_t bits = combine_hash(static_cast<uint32_t>(l), static_cast<uint32_t>(t));
        const int x = static_cast<int>(bits % static_cast<uint32_t>(level.roughness.width()));
        const int y =
            static_cast<int>(mix_bits(bits) % static_cast<uint32_t>(level.roughness.height()));
        const Footprint footprint = footprint_of(surface, x, y, 1 << l, method.slopes);
        const float r = level.roughness.at(x, y);
        OneLobe lobe{footprint.normal, r * r, r * r, 0};
        if (method.anisotropic) {
          lobe.alpha_x = level.alpha_x.at(x, y);
          lobe.alpha_y = level.alpha_y.at(x, y);
          lobe.angle = level.angle.at(x, y);
        }
        const LobeError error = lobe_error(footprint.facets, lobe, 512, bits);
        signed_peaks.push_back(error.peak);
        peaks.push_back(std::abs(error.peak));
        rms.push_back(error.rms);
        albedos.push_back(albedo_error(table, footprint, r));
      }
      fmt::print("{:12} {:5}   {:8.3f} {:8.3f} {:8.3f}   {:8.3f} {:8.3f}   {:8.4f}\n", method.name,
                 l, quantile(signed_peaks, 0.5), quantile(peaks, 0.5), quantile(peaks, 0.9),
                 quantile(rms, 0.5), quantile(rms, 0.9), quantile(albedos, 0.9));
    }
  }
}
