// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>

#include "environments.h"
#include "kiln/image/projection.h"
#include "kiln/parallel/rows.h"
#include "noise.h"

namespace kiln::textures {
namespace {

using Direction = Vec3<double>;

const Direction toward_sun = normalize(Direction{0.62, 0.60, 0.50});
const Color zenith{0.130, 0.250, 0.560};
const Color horizon{0.720, 0.790, 0.860};
const Color haze{0.900, 0.860, 0.760};
const Color soil{0.170, 0.130, 0.088};      ///< reflectance of the ground
const Color sunlight{1.090, 0.980, 0.930};  ///< colour of the sun, luminance about 1

/// Scattered light: deep blue overhead, pale at the horizon, bright around the sun.
Color sky_radiance(const Direction& d) {
  const double height = std::max(d.y, 0.0);
  const double air = std::exp(-3.4 * height);
  const double angle = std::acos(std::clamp(dot(d, toward_sun), -1.0, 1.0));
  const double ahead = dot(d, toward_sun);
  Color color = mix(zenith, horizon, air);
  color = color * (0.88 + 0.16 * (ahead * ahead));
  color += haze * (0.55 * std::exp(-5.5 * angle) + 1.6 * std::exp(-24 * angle));
  return color + haze * (0.22 * std::exp(-16 * height) * (1 + 0.4 * ahead));
}

/// The ground in sun and skylight, fading into the haze at the horizon.
Color ground_radiance(const Direction& d, const Color& lit) {
  const double depth = std::max(-d.y, 1e-3);
  const Point at{d.x / depth, d.z / depth};
  const double patches = fractal_noise({0.04 * at.x, 0.04 * at.y}, {3, 3}, 3, 5);
  const double visible = std::exp(-0.10 / depth);
  const Color earth = lit * (1 + 0.18 * patches * smooth_step(0.05, 0.3, depth));
  return mix(sky_radiance({d.x, 0.0, d.z}) * 0.75, earth, visible);
}

/// Hills on the horizon, pale with distance: sine of the elevation of their crest.
double crest(const Direction& d) {
  const double turn = wrap(std::atan2(d.x, d.z) / (2 * pi));
  return 0.022 + 0.030 * fractal_noise({turn, 0.5}, {7, 1}, 5, 9);
}

Color radiance(const Direction& d, const Color& ground) {
  const Color hill = mix(ground * 0.45, sky_radiance({d.x, 0.02, d.z}), 0.45);
  const Color far = mix(hill, sky_radiance(d), smooth_step(-0.003, 0.003, d.y - crest(d)));
  return mix(ground_radiance(d, ground), far, smooth_step(-0.006, 0.006, d.y));
}

Point texel_point(Size size, int x, int y, double u, double v) {
  return {(x + u) / size.width, (y + v) / size.height};
}

/// Share of a texel's solid angle that the sun's disc covers.
double sun_coverage(Size size, int x, int y) {
  constexpr int grid = 64;
  const double rim = std::cos(sun_diameter_rad / 2);
  double covered = 0, whole = 0;
  for (int j = 0; j < grid; ++j) {
    for (int i = 0; i < grid; ++i) {
      const Point uv = texel_point(size, x, y, (i + 0.5) / grid, (j + 0.5) / grid);
      const double weight = std::sin(pi * uv.y);
      whole += weight;
      if (dot(latlong_to_direction(uv), toward_sun) > rim) covered += weight;
    }
  }
  return covered / whole;
}

/// Adds the sun: its whole energy, radiance times solid angle of the disc, in the texels it covers.
/// The disc is not much larger than a texel, so coverage is counted finely, then scaled to be
/// exact.
void add_sun(Layers& image, double sun_luminance) {
  const Size size = image.size;
  const Point centre = direction_to_latlong(toward_sun);
  const int cx = static_cast<int>(centre.x * size.width),
            cy = static_cast<int>(centre.y * size.height);
  const int reach = 2 + static_cast<int>(sun_diameter_rad / pi * size.height);
  const double disc = 2 * pi * (1 - std::cos(sun_diameter_rad / 2));
  double found = 0;
  for (int y = cy - reach; y <= cy + reach; ++y) {
    for (int x = cx - reach; x <= cx + reach; ++x) {
      found += sun_coverage(size, x, y) * latlong_texel_solid_angle(size, y);
    }
  }
  const Color sun = sunlight * (sun_luminance / luminance(sunlight) * disc / found);
  for (int y = cy - reach; y <= cy + reach; ++y) {
    for (int x = cx - reach; x <= cx + reach; ++x) {
      const Color share = sun * sun_coverage(size, x, y);
      image.layers[0].plane.at(x, y) += static_cast<float>(share.x);
      image.layers[1].plane.at(x, y) += static_cast<float>(share.y);
      image.layers[2].plane.at(x, y) += static_cast<float>(share.z);
    }
  }
}

Color mean_radiance(Size size, int x, int y, const Color& ground) {
  constexpr int grid = 4;
  Color sum{};
  for (int i = 0; i < grid * grid; ++i) {
    const Point uv = texel_point(size, x, y, (i % grid + 0.5) / grid, (i / grid + 0.5) / grid);
    sum += radiance(latlong_to_direction(uv), ground) * (1.0 / (grid * grid));
  }
  return sum;
}

Layers paint(Size size) {
  const double sun_luminance = sun_over_zenith * luminance(sky_radiance({0, 1, 0}));
  const double sun_irradiance =
      sun_luminance * pi * std::pow(sun_diameter_rad / 2, 2) * toward_sun.y;
  const Color lit = soil * (sunlight * (sun_irradiance / pi) + mix(zenith, horizon, 0.35));
  Layers image = make_layers(size, {"R", "G", "B"});
  for_rows(size.height, [&](int y) {
    for (int x = 0; x < size.width; ++x) {
      const Color color = mean_radiance(size, x, y, lit);
      image.layers[0].plane.at(x, y) = shortened(color.x);
      image.layers[1].plane.at(x, y) = shortened(color.y);
      image.layers[2].plane.at(x, y) = shortened(color.z);
    }
  });
  add_sun(image, sun_luminance);
  return image;
}

}  // namespace

Surroundings sky() { return {"sky", {1024, 512}, paint}; }

}  // namespace kiln::textures
