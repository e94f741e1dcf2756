// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "color_planes.h"
#include "finer.h"
#include "hot_texels.h"
#include "kiln/image/projection.h"
#include "kiln/light/angles.h"
#include "kiln/light/irradiance.h"
#include "kiln/light/latlong_texels.h"
#include "kiln/light/prefilter.h"
#include "kiln/parallel/rows.h"
#include "meridian_average.h"

namespace kiln {
namespace {

constexpr int lanes = lane_count<WideFloat>;

// A texel that holds more of a colour's power, and many times its share of the sphere, is too small
// a light to be met evenly by points: what it has above that is dealt out apart.
constexpr double hot_share = 1e-4;
constexpr double hot_times_mean = 4;
constexpr int points_of_hot_texel = 8;  // each way
// Texels of the source, as it is looked up, to the widest texel of the layout.
constexpr double most_source_texels = 4;

/// What hot texels have above the limit, dealt out to the texels that points in them lie in.
class Spill {
 public:
  Spill(const SphereGrid& grid, const std::vector<Layers>& images)
      : layout_(grid.layout),
        turns_(grid.rotate_deg / 360),
        size_(images.front().size),
        power_(images.size()) {}

  void deal(Size source, const HotTexel& texel, const PowerLimit& limit);
  void add_to(int image, Layers& to) const;

 private:
  void add(const Vec3<double>& d, const std::array<double, 3>& power);

  SphereLayout layout_;
  double turns_;
  Size size_;
  std::vector<std::vector<std::array<double, 3>>> power_;  ///< [images][texels], empty while dark
};

void Spill::deal(Size source, const HotTexel& texel, const PowerLimit& limit) {
  constexpr int n = points_of_hot_texel;
  const double solid_angle = latlong_texel_solid_angle(source, texel.y);
  std::array<double, 3> power{};
  for (size_t c = 0; c < 3; ++c) {
    const double most = limit.radiance(c, solid_angle) * solid_angle;
    power[c] = (texel.power[c] - std::clamp(texel.power[c], -most, most)) / (n * n);
  }
  const double top = std::cos(pi * texel.y / source.height);
  const double bottom = std::cos(pi * (texel.y + 1) / source.height);
  for (int i = 0; i < n; ++i) {
    const double phi_rad = 2 * pi * ((texel.x + (i + 0.5) / n) / source.width - turns_ - 0.5);
    const double sine = std::sin(phi_rad), cosine = std::cos(phi_rad);
    for (int j = 0; j < n; ++j) {
      const double y = lerp(top, bottom, (j + 0.5) / n);
      const double r = safe_sqrt(1 - y * y);
      add({-sine * r, y, cosine * r}, power);
    }
  }
}

void Spill::add(const Vec3<double>& d, const std::array<double, 3>& power) {
  int image = 0;
  Vec2<double> uv;
  if (layout_ == SphereLayout::Octahedral) {
    uv = direction_to_octahedral(d);
  } else {
    const CubePoint point = direction_to_cube(d);
    image = static_cast<int>(point.face);
    uv = point.uv;
  }
  auto& texels = power_[static_cast<size_t>(image)];
  if (texels.empty()) texels.resize(static_cast<size_t>(area(size_)));
  const auto index = [](double u, int count) {
    return std::clamp(static_cast<int>(u * count), 0, count - 1);
  };
  auto& texel =
      texels[static_cast<size_t>(index(uv.y, size_.height)) * static_cast<size_t>(size_.width) +
             static_cast<size_t>(index(uv.x, size_.width))];
  for (size_t c = 0; c < 3; ++c) texel[c] += power[c];
}

void Spill::add_to(int image, Layers& to) const {
  const auto& texels = power_[static_cast<size_t>(image)];
  for (size_t i = 0; i < texels.size(); ++i) {
    if (texels[i] == std::array<double, 3>{}) continue;
    const int x = static_cast<int>(i) % size_.width, y = static_cast<int>(i) / size_.width;
    const double solid_angle = layout_ == SphereLayout::Octahedral
                                   ? octahedral_texel_solid_angle(size_.width, x, y)
                                   : cube_texel_solid_angle(size_.width, x, y);
    for (size_t c = 0; c < 3; ++c) {
      to.layers[c].plane.at(x, y) += static_cast<float>(texels[i][c] / solid_angle);
    }
  }
}

// Of powers of two, the greatest that divides both sides of the image and leaves its texels fine
// enough.
int reduction_for(Size source, double source_texels) {
  int times = 1;
  while (source.width % (2 * times) == 0 && source.height % (2 * times) == 0 &&
         source_texels / times > most_source_texels) {
    times *= 2;
  }
  return times;
}

// Mean over blocks of texels, weighted by solid angle, of what is within the limit.
Layers reduced(const ColorPlanes& source, const PowerLimit& limit, int times) {
  const Size size{source.size.width / times, source.size.height / times};
  Layers result = make_layers(size, {"R", "G", "B"});
  for_rows(size.height, [&](int y) {
    double whole = 0;
    for (int j = 0; j < times; ++j) {
      whole += times * latlong_texel_solid_angle(source.size, y * times + j);
    }
    for (size_t c = 0; c < 3; ++c) {
      std::vector<double> sums(static_cast<size_t>(size.width), 0.0);
      for (int j = 0; j < times; ++j) {
        const double solid_angle = latlong_texel_solid_angle(source.size, y * times + j);
        const float most = limit.radiance(c, solid_angle);
        const float* row = source.planes[c]->row(y * times + j);
        for (int x = 0; x < source.size.width; ++x) {
          sums[static_cast<size_t>(x / times)] +=
              solid_angle / whole * std::clamp(row[x], -most, most);
        }
      }
      float* to = result.layers[c].plane.row(y);
      for (int x = 0; x < size.width; ++x) to[x] = static_cast<float>(sums[static_cast<size_t>(x)]);
    }
  });
  return result;
}

/// A source to be looked up at points in each texel of a layout.
struct Points {
  LatLongTexels texels;
  int count;  ///< per texel, each way
};

LatLongTexels within_limit(const Layers& latlong, const PowerLimit& limit,
                           const std::vector<HotTexel>& hot) {
  LatLongTexels texels(latlong, latlong.size.width, Pole::AcrossByHalfATurn);
  const ColorPlanes source = color_planes(latlong);
  for (const HotTexel& texel : hot) {
    const double solid_angle = latlong_texel_solid_angle(latlong.size, texel.y);
    const auto clamped = [&](size_t c) {
      const float most = limit.radiance(c, solid_angle);
      return std::clamp(source.planes[c]->at(texel.x, texel.y), -most, most);
    };
    texels.set_color(texel.x, texel.y, {clamped(0), clamped(1), clamped(2)});
  }
  return texels;
}

Points make_points(const Layers& latlong, const PowerLimit& limit, const std::vector<HotTexel>& hot,
                   double source_texels) {
  const int times = reduction_for(latlong.size, source_texels);
  const int count = std::max(1, static_cast<int>(std::ceil(1.5 * source_texels / times)));
  if (times == 1) return {within_limit(latlong, limit, hot), count};
  const Layers coarser = reduced(color_planes(latlong), limit, times);
  return {LatLongTexels(coarser, coarser.size.width, Pole::AcrossByHalfATurn), count};
}

WideFloat count_up() {
  float values[lanes];
  for (int i = 0; i < lanes; ++i) values[i] = static_cast<float>(i);
  return load_lanes<WideFloat>(values);
}

/// A point of an image: its direction, not normalised, and what solid angle goes as there.
struct Point {
  Vec3<WideFloat> direction;
  WideFloat weight;
};

Vec3<WideFloat> point_of_face(CubeFace face, const Vec2<WideFloat>& uv) {
  const auto part = [&](double middle, double right, double down) {
    return fma(
        uv.x, WideFloat(static_cast<float>(right)),
        fma(uv.y, WideFloat(static_cast<float>(down)), WideFloat(static_cast<float>(middle))));
  };
  const Vec3<double> corner = cube_to_direction(face, {0, 0});
  const Vec3<double> right = cube_to_direction(face, {1, 0}) - corner;
  const Vec3<double> down = cube_to_direction(face, {0, 1}) - corner;
  return {part(corner.x, right.x, down.x), part(corner.y, right.y, down.y),
          part(corner.z, right.z, down.z)};
}

Point point_of_latlong(const Vec2<WideFloat>& uv) {
  const auto azimuth = sine_cosine_of_turns(uv.x - WideFloat(0.5f));
  const auto polar = sine_cosine_of_turns(WideFloat(0.5f) * uv.y);
  return {{-azimuth.sine * polar.sine, polar.cosine, azimuth.cosine * polar.sine},
          abs(polar.sine) + WideFloat(1e-6f)};
}

// On plane faces solid angle goes as one over the length cubed.
Point point_of(SphereLayout layout, int image, const Vec2<WideFloat>& uv) {
  if (layout == SphereLayout::LatLong) return point_of_latlong(uv);
  const Vec3<WideFloat> d = layout == SphereLayout::Octahedral
                                ? octahedral_point(uv)
                                : point_of_face(static_cast<CubeFace>(image), uv);
  const WideFloat inverse = WideFloat(1.0f) / length(d);
  return {d * inverse, inverse * inverse * inverse};
}

// A point of the world in the texels of an image turned by so much.
Vec2<WideFloat> in_texels(Size size, const Vec2<WideFloat>& uv, double turns) {
  const WideFloat turned = uv.x + WideFloat(static_cast<float>(turns));
  const WideFloat u = turned - floor(turned);
  return {fma(u, WideFloat(static_cast<float>(size.width)), WideFloat(0.5f)),
          fma(uv.y, WideFloat(static_cast<float>(size.height)), WideFloat(0.5f))};
}

// As many texels of row y as a wide number has lanes, from texel x on.
Vec3<WideFloat> average_at(const Points& points, const SphereGrid& grid, int image, int x, int y) {
  const double n = points.count;
  const Vec2<double> origin = grid.point(0, 0), next = grid.point(1, 1);
  const Vec2<double> step{next.x - origin.x, next.y - origin.y};
  const WideFloat first = count_up() + WideFloat(static_cast<float>(x));
  Vec3<WideFloat> sum{WideFloat(0.0f), WideFloat(0.0f), WideFloat(0.0f)};
  WideFloat weights(0.0f);
  for (int j = 0; j < points.count; ++j) {
    const double v = origin.y + step.y * (y - 0.5 + (j + 0.5) / n);
    for (int i = 0; i < points.count; ++i) {
      const double from = origin.x + step.x * (-0.5 + (i + 0.5) / n);
      const WideFloat u =
          fma(first, WideFloat(static_cast<float>(step.x)), WideFloat(static_cast<float>(from)));
      const Point point = point_of(grid.layout, image, {u, WideFloat(static_cast<float>(v))});
      sum += points.texels.bilinear(in_texels(points.texels.size(), latlong_of(point.direction),
                                              grid.rotate_deg / 360)) *
             point.weight;
      weights += point.weight;
    }
  }
  return sum * (WideFloat(1.0f) / weights);
}

void average_rows(const Points& points, const SphereGrid& grid, int image, Layers& to) {
  for_rows(to.size.height, [&](int y) {
    for (int x = 0; x < to.size.width; x += lanes) {  // rows are padded to whole wide numbers
      const Vec3<WideFloat> value = average_at(points, grid, image, x, y);
      store_lanes(to.layers[0].plane.row(y) + x, value.x);
      store_lanes(to.layers[1].plane.row(y) + x, value.y);
      store_lanes(to.layers[2].plane.row(y) + x, value.z);
    }
  });
}

// Rows of the source to the widest texel of a grid.
double source_texels_of(const SphereGrid& grid, Size source) {
  const int rows = grid.image_size().height;
  double widest_rad = pi / rows;
  if (grid.layout == SphereLayout::Cube) widest_rad = 2.0 / rows;
  if (grid.layout == SphereLayout::Octahedral) widest_rad = 2 * std::sqrt(3.0) / rows;
  return widest_rad * source.height / pi;
}

double power_of(const Plane& plane, const std::vector<double>& weights) {
  const auto sums = sum_rows(plane.height(), 1, [&](int y, std::vector<double>& row) {
    const size_t first = static_cast<size_t>(y) * static_cast<size_t>(plane.width());
    for (int x = 0; x < plane.width(); ++x) {
      row[0] += plane.at(x, y) * weights[first + static_cast<size_t>(x)];
    }
  });
  return sums[0];
}

// Averages by points miss a little of the power, or find too much: they are scaled so that, with
// the others, the whole is that of the source. Nothing is scaled where power nearly cancels.
void keep_power(const Vec3<double>& mean, const SphereGrid& grid,
                const std::vector<bool>& by_points, std::vector<Layers>& images) {
  const std::vector<double> weights = solid_angles(grid);
  const std::array<double, 3> whole = {4 * pi * mean.x, 4 * pi * mean.y, 4 * pi * mean.z};
  for (size_t c = 0; c < 3; ++c) {
    double exact = 0, found = 0;
    for (size_t i = 0; i < images.size(); ++i) {
      (by_points[i] ? found : exact) += power_of(images[i].layers[c].plane, weights);
    }
    const auto scale = static_cast<float>((whole[c] - exact) / found);
    if (!(std::abs(scale - 1) < 0.01f)) continue;
    for (size_t i = 0; i < images.size(); ++i) {
      Plane& plane = images[i].layers[c].plane;
      for (int y = 0; by_points[i] && y < plane.height(); ++y) {
        for (int x = 0; x < plane.width(); ++x) plane.row(y)[x] *= scale;
      }
    }
  }
}

bool is_side(CubeFace face) { return face != CubeFace::py && face != CubeFace::ny; }

// Texels that are finer than the source's would show these as boxes: then all faces are looked up
// at points, else only those where meridians are no columns.
void average_images(const Layers& latlong, const SphereGrid& grid, std::vector<Layers>& images) {
  const ColorPlanes source = color_planes(latlong);
  const double source_texels = source_texels_of(grid, latlong.size);
  const double mean_share = 1.0 / static_cast<double>(area(latlong.size));
  PowerLimit limit = share_of_power(source, std::max(hot_share, hot_times_mean * mean_share));
  limit.least_solid_angle = 4 * pi * mean_share / 8;
  if (grid.at_nodes) limit.most = {INFINITY, INFINITY, INFINITY};
  const std::vector<HotTexel> hot = hot_texels(source, limit);
  const Points points = make_points(latlong, limit, hot, source_texels);
  const bool sides_apart =
      grid.layout == SphereLayout::Cube && !grid.at_nodes && source_texels >= 1;
  if (sides_apart) average_over_sides(source, limit, grid.rotate_deg / 360, images);
  Spill spill(grid, images);
  for (const HotTexel& texel : hot) spill.deal(latlong.size, texel, limit);
  std::vector<bool> by_points;
  for (size_t i = 0; i < images.size(); ++i) {
    const int image = static_cast<int>(i);
    by_points.push_back(!sides_apart || !is_side(static_cast<CubeFace>(i)));
    if (by_points[i]) average_rows(points, grid, image, images[i]);
    spill.add_to(image, images[i]);
  }
  if (!grid.at_nodes) keep_power(mean_radiance(latlong), grid, by_points, images);
}

}  // namespace

std::vector<Layers> average_over_texels(const Layers& latlong, const SphereGrid& grid) {
  std::vector<Layers> images;
  for (int i = 0; i < grid.images(); ++i) {
    images.push_back(make_layers(grid.image_size(), {"R", "G", "B"}));
  }
  if (grid.layout == SphereLayout::LatLong && !grid.at_nodes) {
    average_over_latlong(color_planes(latlong), grid.rotate_deg / 360, images.front());
  } else {
    average_images(latlong, grid, images);
  }
  return images;
}

Layers finer(const Layers& latlong, const Refinement& times) {
  const LatLongTexels source(latlong, latlong.size.width, Pole::Clamped);
  const Size size{latlong.size.width * times.across, latlong.size.height * times.down};
  const float right = 1 / static_cast<float>(times.across),
              down = 1 / static_cast<float>(times.down);
  Layers result = make_layers(size, {"R", "G", "B"});
  for_rows(size.height, [&](int y) {
    for (int x = 0; x < size.width; ++x) {
      const Vec3<float> value =
          source.bilinear(Vec2<float>{(static_cast<float>(x) + 0.5f) * right + 0.5f,
                                      (static_cast<float>(y) + 0.5f) * down + 0.5f});
      result.layers[0].plane.at(x, y) = value.x;
      result.layers[1].plane.at(x, y) = value.y;
      result.layers[2].plane.at(x, y) = value.z;
    }
  });
  return result;
}

}  // namespace kiln
