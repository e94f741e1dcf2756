// SPDX-License-Identifier: Apache-2.0
#include "kiln/light/irradiance.h"

#include <algorithm>
#include <array>

#include "color_planes.h"
#include "kiln/image/projection.h"
#include "kiln/math/sums.h"
#include "kiln/parallel/rows.h"

namespace kiln {
namespace {

Vec3<double> texel_direction(Size size, int x, int y) {
  return latlong_to_direction(Vec2<double>{(x + 0.5) / size.width, (y + 0.5) / size.height});
}

/// Sums along part of a row: of L, L cos(phi) and L sin(phi).
struct Moments {
  Vec3<double> plain, cosine, sine;

  friend Moments operator+(const Moments& a, const Moments& b) {
    return {a.plain + b.plain, a.cosine + b.cosine, a.sine + b.sine};
  }
  friend Moments operator-(const Moments& a, const Moments& b) {
    return {a.plain - b.plain, a.cosine - b.cosine, a.sine - b.sine};
  }
};

/// One row of the image: its polar angle, and its moments up to each column.
struct Row {
  double sine, cosine, solid_angle;
  std::vector<Moments> up_to;  ///< [columns + 1]

  /// Moments of `count` columns from `first` on, around the image.
  Moments arc(long first, long count) const {
    const auto width = static_cast<long>(up_to.size()) - 1;
    const long from = ((first % width) + width) % width, end = from + count;
    const auto at = [this](long x) { return up_to[static_cast<size_t>(x)]; };
    if (end <= width) return at(end) - at(from);
    return at(width) - at(from) + at(end - width);
  }
};

/// @param radiance_at  texel (x, y)
template <class Radiance>
Row sum_along_row(Size size, int y, const Radiance& radiance_at) {
  const double theta = pi * (y + 0.5) / size.height;
  Row row{std::sin(theta), std::cos(theta), latlong_texel_solid_angle(size, y), {}};
  row.up_to.resize(static_cast<size_t>(size.width) + 1);
  for (int x = 0; x < size.width; ++x) {
    const double phi = 2 * pi * ((x + 0.5) / size.width - 0.5);
    const Vec3<double> radiance = radiance_at(x, y);
    const auto i = static_cast<size_t>(x);
    row.up_to[i + 1] =
        row.up_to[i] + Moments{radiance, radiance * std::cos(phi), radiance * std::sin(phi)};
  }
  return row;
}

// On a row, n.w = a + b cos(phi - phi_n): above the horizon lies an arc around phi_n.
Vec3<double> sum_above_horizon(const Row& row, const Vec3<double>& n) {
  const auto width = static_cast<double>(row.up_to.size() - 1);
  const double a = n.y * row.cosine;
  const double b = std::sqrt(n.x * n.x + n.z * n.z) * row.sine;
  if (a <= -b) return {};
  Moments sum = row.up_to.back();
  if (a < b) {
    const double middle = (std::atan2(-n.x, n.z) / (2 * pi) + 0.5) * width - 0.5;
    const double half = std::acos(-a / b) / (2 * pi) * width;
    const auto first = static_cast<long>(std::ceil(middle - half));
    const auto last = static_cast<long>(std::floor(middle + half));
    const long count = std::min(last - first + 1, static_cast<long>(width));
    if (count <= 0) return {};
    sum = row.arc(first, count);
  }
  return (sum.plain * a + (sum.cosine * n.z - sum.sine * n.x) * row.sine) * row.solid_angle;
}

/// Irradiance over pi of each normal.
template <class Radiance>
std::vector<Vec3<double>> sums_above_horizons(Size size, std::span<const Vec3<double>> normals,
                                              const Radiance& radiance_at) {
  constexpr int rows_at_once = 16;
  constexpr int normals_at_once = 64;
  const auto count = static_cast<int>(normals.size());
  std::vector<Vec3<double>> irradiance(normals.size());
  std::vector<Row> rows(rows_at_once);
  for (int y = 0; y < size.height; y += rows_at_once) {
    const int found = std::min(rows_at_once, size.height - y);
    for_rows(found, [&](int i) {
      rows[static_cast<size_t>(i)] = sum_along_row(size, y + i, radiance_at);
    });
    for_rows((count + normals_at_once - 1) / normals_at_once, [&](int block) {
      const int end = std::min(count, (block + 1) * normals_at_once);
      for (int k = block * normals_at_once; k < end; ++k) {
        const auto at = static_cast<size_t>(k);
        for (int i = 0; i < found; ++i) {
          irradiance[at] += sum_above_horizon(rows[static_cast<size_t>(i)], normals[at]) * (1 / pi);
        }
      }
    });
  }
  return irradiance;
}

}  // namespace

Vec3<double> mean_radiance(const Layers& latlong) {
  const ColorPlanes colors = color_planes(latlong);
  const auto sums = sum_rows(colors.size.height, 3, [&](int y, std::vector<double>& share) {
    const double weight = latlong_texel_solid_angle(colors.size, y) / (4 * pi);
    for (size_t c = 0; c < 3; ++c) {
      share[c] = sum_of(colors.planes[c]->texels_of_row(y)) * weight;
    }
  });
  return {sums[0], sums[1], sums[2]};
}

Vec3<double> irradiance_over_pi(const Layers& latlong, const Vec3<double>& n) {
  const ColorPlanes colors = color_planes(latlong);
  const auto sums = sum_rows(colors.size.height, 3, [&](int y, std::vector<double>& share) {
    Vec3<double> sum;
    for (int x = 0; x < colors.size.width; ++x) {
      sum += colors.at(x, y) * std::max(0.0, dot(n, texel_direction(colors.size, x, y)));
    }
    sum = sum * (latlong_texel_solid_angle(colors.size, y) / pi);
    share = {sum.x, sum.y, sum.z};
  });
  return {sums[0], sums[1], sums[2]};
}

std::vector<Vec3<double>> irradiance_over_pi(const Layers& latlong,
                                             std::span<const Vec3<double>> normals) {
  const ColorPlanes colors = color_planes(latlong);
  return sums_above_horizons(latlong.size, normals, [&](int x, int y) { return colors.at(x, y); });
}

// The sum over texel centres gives a constant environment up to their spacing; dividing by what it
// makes of the constant 1 gives it exactly.
std::vector<Vec3<double>> normalised_irradiance(const Layers& latlong,
                                                std::span<const Vec3<double>> normals) {
  const Plane* weights = latlong.find("W");
  const auto constant = sums_above_horizons(latlong.size, normals, [&](int x, int y) {
    const double weight = weights ? weights->at(x, y) : 1;
    return Vec3<double>{weight, weight, weight};
  });
  auto irradiance = irradiance_over_pi(latlong, normals);
  for (size_t i = 0; i < irradiance.size(); ++i) {
    irradiance[i] = irradiance[i] * (1 / constant[i].x);
  }
  return irradiance;
}

IrradianceMap::IrradianceMap(const Layers& latlong, double rotate_deg)
    : image_(make_layers(map_size, {"R", "G", "B"})), turn_(rotate_deg) {
  std::vector<Vec3<double>> normals;
  for (int y = 0; y < map_size.height; ++y) {
    for (int x = 0; x < map_size.width; ++x) normals.push_back(texel_direction(map_size, x, y));
  }
  const auto irradiance = normalised_irradiance(latlong, normals);
  for (int y = 0; y < map_size.height; ++y) {
    for (int x = 0; x < map_size.width; ++x) {
      const auto at = static_cast<size_t>(y * map_size.width + x);
      const Vec3<double>& value = irradiance[at];
      image_.layers[0].plane.at(x, y) = static_cast<float>(value.x);
      image_.layers[1].plane.at(x, y) = static_cast<float>(value.y);
      image_.layers[2].plane.at(x, y) = static_cast<float>(value.z);
    }
  }
  texels_ = LatLongTexels(image_, map_size.width, Pole::AcrossByHalfATurn);
}

}  // namespace kiln
