// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "kiln/image/projection.h"
#include "kiln/light/irradiance.h"
#include "kiln/light/specular_chain.h"
#include "kiln/parallel/rows.h"
#include "lobe.h"
#include "synthetic.h"

namespace kiln::test {

/// The sum that a filtered level stands for, texel by texel in double.
class BruteForce {
 public:
  explicit BruteForce(const Layers& latlong) {
    const Size size = latlong.size;
    for (int y = 0; y < size.height; ++y) {
      const double solid_angle = latlong_texel_solid_angle(size, y);
      for (int x = 0; x < size.width; ++x) {
        add(texel_direction(size, x, y), solid_angle,
            {latlong.layers[0].plane.at(x, y), latlong.layers[1].plane.at(x, y),
             latlong.layers[2].plane.at(x, y)});
      }
    }
    while (x_.size() % static_cast<size_t>(lanes) != 0) add({1, 0, 0}, 0, {0, 0, 0});
  }

  Vec3<double> filtered(const Vec3<double>& d, double alpha) const {
    std::array<WideDouble, 4> sums;
    sums.fill(WideDouble(0.0));
    for (size_t i = 0; i < x_.size(); i += lanes) {
      const Vec3<WideDouble> apart{WideDouble(d.x) - load_lanes<WideDouble>(x_.data() + i),
                                   WideDouble(d.y) - load_lanes<WideDouble>(y_.data() + i),
                                   WideDouble(d.z) - load_lanes<WideDouble>(z_.data() + i)};
      const WideDouble lobe = lobe_at(Ggx<WideDouble>::isotropic(WideDouble(alpha)),
                                      WideDouble(0.25) * dot(apart, apart));
      for (size_t c = 0; c < 4; ++c) {
        sums[c] = fma(lobe, load_lanes<WideDouble>(power_[c].data() + i), sums[c]);
      }
    }
    const double weight = xsimd::hadd(sums[3]);
    return {xsimd::hadd(sums[0]) / weight, xsimd::hadd(sums[1]) / weight,
            xsimd::hadd(sums[2]) / weight};
  }

 private:
  static constexpr int lanes = lane_count<WideDouble>;

  void add(const Vec3<double>& d, double solid_angle, const Vec3<double>& radiance) {
    x_.push_back(d.x);
    y_.push_back(d.y);
    z_.push_back(d.z);
    power_[0].push_back(radiance.x * solid_angle);
    power_[1].push_back(radiance.y * solid_angle);
    power_[2].push_back(radiance.z * solid_angle);
    power_[3].push_back(solid_angle);
  }

  std::vector<double> x_, y_, z_;
  std::array<std::vector<double>, 4> power_;  // R G B times solid angle, solid angle
};

struct CubeTexelAt {
  int face, x, y;
};

/// Texels of a level: some at random, and all within 6 texels of a direction on its face.
struct ProbedTexels {
  std::vector<CubeTexelAt> random, near;
};

inline ProbedTexels probe(int size, int count, const Vec3<double>& around) {
  ProbedTexels probed;
  for (int i = 0; i < count; ++i) {
    const auto pick = [&](int number, int below) {
      return static_cast<int>(random_unit(static_cast<std::uint32_t>(size),
                                          static_cast<std::uint32_t>(3 * i + number)) *
                              below);
    };
    probed.random.push_back({pick(0, 6), pick(1, size), pick(2, size)});
  }
  const CubePoint middle = direction_to_cube(around);
  const int x0 = static_cast<int>(middle.uv.x * size), y0 = static_cast<int>(middle.uv.y * size);
  for (int y = std::max(0, y0 - 6); y <= std::min(size - 1, y0 + 6); ++y) {
    for (int x = std::max(0, x0 - 6); x <= std::min(size - 1, x0 + 6); ++x) {
      probed.near.push_back({static_cast<int>(middle.face), x, y});
    }
  }
  return probed;
}

struct LevelError {
  double rms = 0, max = 0;
};

/// Error of texels of a level against brute force, of all colours, in units of the mean radiance.
inline LevelError error_of(const SpecularChain& chain, int level, const BruteForce& truth,
                           const Vec3<double>& mean, const std::vector<CubeTexelAt>& texels) {
  const int size = chain.size(level);
  const double alpha = chain.roughness(level) * chain.roughness(level);
  std::vector<Layers> faces;
  for (int face = 0; face < 6; ++face) {
    faces.push_back(chain.face(level, static_cast<CubeFace>(face)));
  }
  std::vector<Vec3<double>> errors(texels.size());
  for_rows(static_cast<int>(texels.size()), [&](int i) {
    const CubeTexelAt& at = texels[static_cast<size_t>(i)];
    const Vec2<double> uv{(at.x + 0.5) / size, (at.y + 0.5) / size};
    const Vec3<double> expected =
        truth.filtered(normalize(cube_to_direction(static_cast<CubeFace>(at.face), uv)), alpha);
    const auto found = [&](size_t c) -> double {
      return faces[static_cast<size_t>(at.face)].layers[c].plane.at(at.x, at.y);
    };
    errors[static_cast<size_t>(i)] = {(found(0) - expected.x) / mean.x,
                                      (found(1) - expected.y) / mean.y,
                                      (found(2) - expected.z) / mean.z};
  });
  LevelError result;
  double sum = 0;
  for (const Vec3<double>& e : errors) {
    sum += dot(e, e) / 3;
    result.max = std::max({result.max, std::abs(e.x), std::abs(e.y), std::abs(e.z)});
  }
  result.rms = std::sqrt(sum / static_cast<double>(errors.size()));
  return result;
}

/// Direction of the texel with the highest green.
inline Vec3<double> brightest_direction(const Layers& latlong) {
  const Plane& green = latlong.layers[1].plane;
  int best_x = 0, best_y = 0;
  for (int y = 0; y < latlong.size.height; ++y) {
    for (int x = 0; x < latlong.size.width; ++x) {
      if (green.at(x, y) > green.at(best_x, best_y)) {
        best_x = x;
        best_y = y;
      }
    }
  }
  return texel_direction(latlong.size, best_x, best_y);
}

}  // namespace kiln::test
