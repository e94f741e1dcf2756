// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <numeric>
#include <optional>

#include "color_planes.h"
#include "finer.h"
#include "hot_texels.h"
#include "kiln/image/projection.h"
#include "kiln/light/angles.h"
#include "kiln/light/irradiance.h"
#include "kiln/light/latlong_texels.h"
#include "kiln/light/prefilter.h"
#include "kiln/light/turn.h"
#include "kiln/parallel/rows.h"
#include "meridian_average.h"

namespace kiln {
namespace {

constexpr int lanes = lane_count<WideFloat>;

// A source texel that holds more of a colour's power, and many times its share of the sphere, is a
// small light: texels near it are averaged over more points.
constexpr double hot_share = 1e-5;
constexpr double hot_times_mean = 10;
constexpr int points_near_hot = 16;  // each way
// Texels of the source, as it is looked up, to the widest texel of the layout.
constexpr double most_source_texels = 2.5;

/// Texels near a small light, by image; empty where there is none.
class NearHot {
 public:
  NearHot(const SphereGrid& grid, const ColorPlanes& source);

  bool in(int image) const { return !near_[static_cast<size_t>(image)].empty(); }
  /// Whether any of so many texels from (x, y) on is near.
  bool any(int image, int x, int y, int count) const;

 private:
  void mark(const Vec3<double>& d, int reach);

  SphereGrid grid_;
  Size size_;
  std::vector<std::vector<bool>> near_;
};

std::vector<HotTexel> small_lights(const ColorPlanes& source) {
  const double mean_share = 1.0 / static_cast<double>(area(source.size));
  PowerLimit limit = share_of_power(source, std::max(hot_share, hot_times_mean * mean_share));
  limit.least_solid_angle = 4 * pi * mean_share / 8;
  return hot_texels(source, limit);
}

/// Where a direction lies on the plane of a face, or in an image; nothing behind a face.
std::optional<Vec2<int>> nearest(const SphereGrid& grid, int image, const Vec3<double>& d) {
  const Size size = grid.image_size();
  Vec2<double> uv;
  if (grid.layout == SphereLayout::Cube) {
    const auto face = static_cast<CubeFace>(image);
    const Vec3<double> middle = cube_to_direction(face, {0.5, 0.5});
    const double along = dot(d, middle);
    if (along < 0.3) return std::nullopt;
    const Vec3<double> right = cube_to_direction(face, {1, 0.5}) - middle;
    const Vec3<double> down = cube_to_direction(face, {0.5, 1}) - middle;
    uv = {0.5 + 0.5 * dot(d, right) / along, 0.5 + 0.5 * dot(d, down) / along};
  } else {
    uv = grid.layout == SphereLayout::Octahedral ? direction_to_octahedral(d)
                                                 : direction_to_latlong(d);
  }
  return Vec2<int>{static_cast<int>(std::floor(uv.x * size.width)),
                   static_cast<int>(std::floor(uv.y * size.height))};
}

// What a light of a texel, as it is looked up, may reach: two texels of the source, and one more.
NearHot::NearHot(const SphereGrid& grid, const ColorPlanes& source)
    : grid_(grid), size_(grid.image_size()), near_(static_cast<size_t>(grid.images())) {
  const Turn turn(grid.rotate_deg);
  const double texel_rad = 2.0 / size_.height;
  const int reach = 1 + static_cast<int>(std::ceil(2 * pi / source.size.height / texel_rad));
  for (const HotTexel& texel : small_lights(source)) {
    const Vec2<double> uv{(texel.x + 0.5) / source.size.width,
                          (texel.y + 0.5) / source.size.height};
    mark(turn.to_world(latlong_to_direction(uv)), reach);
  }
}

void NearHot::mark(const Vec3<double>& d, int reach) {
  for (int image = 0; image < grid_.images(); ++image) {
    const auto at = nearest(grid_, image, d);
    if (!at) continue;
    auto& texels = near_[static_cast<size_t>(image)];
    for (int y = at->y - reach; y <= at->y + reach; ++y) {
      for (int x = at->x - reach; x <= at->x + reach; ++x) {
        if (x < 0 || y < 0 || x >= size_.width || y >= size_.height) continue;
        texels.resize(static_cast<size_t>(area(size_)));
        texels[static_cast<size_t>(y) * static_cast<size_t>(size_.width) + static_cast<size_t>(x)] =
            true;
      }
    }
  }
}

bool NearHot::any(int image, int x, int y, int count) const {
  const auto& texels = near_[static_cast<size_t>(image)];
  if (texels.empty()) return false;
  const size_t first = static_cast<size_t>(y) * static_cast<size_t>(size_.width);
  bool found = false;
  for (int i = x; i < std::min(x + count, size_.width); ++i) {
    found = found || texels[first + static_cast<size_t>(i)];
  }
  return found;
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

// Mean over blocks of texels, weighted by solid angle.
Layers reduced(const ColorPlanes& source, int times) {
  const Size size{source.size.width / times, source.size.height / times};
  Layers result = make_layers(size, {"R", "G", "B"});
  for_rows(size.height, [&](int y) {
    double whole = 0;
    for (int j = 0; j < times; ++j) {
      whole += times * latlong_texel_solid_angle(source.size, y * times + j);
    }
    for (size_t c = 0; c < 3; ++c) {
      std::vector<double> columns(static_cast<size_t>(source.size.width), 0.0);
      for (int j = 0; j < times; ++j) {
        const double weight = latlong_texel_solid_angle(source.size, y * times + j) / whole;
        const float* row = source.planes[c]->row(y * times + j);
        for (double& sum : columns) sum = fma(weight, *row++, sum);
      }
      const double* from = columns.data();
      for (float& texel :
           std::span(result.layers[c].plane.row(y), static_cast<size_t>(size.width))) {
        texel = static_cast<float>(std::accumulate(from, from + times, 0.0));
        from += times;
      }
    }
  });
  return result;
}

/// A source to be looked up at points in each texel of a layout.
struct Points {
  LatLongTexels texels;
  int count;  ///< per texel, each way
  NearHot near_hot;

  int count_at(int image, int x, int y) const {
    return near_hot.any(image, x, y, lanes) ? std::max(count, points_near_hot) : count;
  }
};

Points make_points(const Layers& latlong, const SphereGrid& grid, double source_texels) {
  const int times = reduction_for(latlong.size, source_texels);
  const int count = std::max(1, static_cast<int>(std::ceil(1.5 * source_texels / times)));
  const Layers coarser = times > 1 ? reduced(color_planes(latlong), times) : Layers{};
  const Layers& image = times > 1 ? coarser : latlong;
  return {LatLongTexels(image, image.size.width, Pole::AcrossByHalfATurn), count,
          NearHot(grid, color_planes(image))};
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
  const int count = points.count_at(image, x, y);
  const double n = count;
  const Vec2<double> origin = grid.point(0, 0), next = grid.point(1, 1);
  const Vec2<double> step{next.x - origin.x, next.y - origin.y};
  const WideFloat first = count_up() + WideFloat(static_cast<float>(x));
  Vec3<WideFloat> sum{WideFloat(0.0f), WideFloat(0.0f), WideFloat(0.0f)};
  WideFloat weights(0.0f);
  for (int j = 0; j < count; ++j) {
    const double v = origin.y + step.y * (y - 0.5 + (j + 0.5) / n);
    for (int i = 0; i < count; ++i) {
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

/// Power of texels that may be scaled, and of all others.
struct Powers {
  double loose = 0, fixed = 0;
};

template <class IsLoose>
Powers powers_of(const Plane& plane, const std::vector<double>& weights, const IsLoose& is_loose) {
  const auto sums = sum_rows(plane.height(), 2, [&](int y, std::vector<double>& row) {
    const size_t first = static_cast<size_t>(y) * static_cast<size_t>(plane.width());
    for (int x = 0; x < plane.width(); ++x) {
      row[is_loose(x, y) ? 0 : 1] += plane.at(x, y) * weights[first + static_cast<size_t>(x)];
    }
  });
  return {sums[0], sums[1]};
}

template <class IsLoose>
void scale_texels(float scale, const IsLoose& is_loose, Plane& plane) {
  for (int y = 0; y < plane.height(); ++y) {
    for (int x = 0; x < plane.width(); ++x) {
      if (is_loose(x, y)) plane.row(y)[x] *= scale;
    }
  }
}

// Averages by points miss a little of the power, or find too much, above all of small lights:
// texels near these, or all where there are none, are scaled so that the whole is that of the
// source. Nothing is scaled where power nearly cancels.
void keep_power(const Vec3<double>& mean, const SphereGrid& grid, const NearHot& near_hot,
                const std::vector<bool>& by_points, std::vector<Layers>& images) {
  const std::vector<double> weights = solid_angles(grid);
  const std::array<double, 3> whole = {4 * pi * mean.x, 4 * pi * mean.y, 4 * pi * mean.z};
  bool any_hot = false;
  for (size_t i = 0; i < images.size(); ++i) {
    any_hot = any_hot || (by_points[i] && near_hot.in(static_cast<int>(i)));
  }
  const auto loose_in = [&](size_t image) {
    return [&, image](int x, int y) {
      return by_points[image] && (!any_hot || near_hot.any(static_cast<int>(image), x, y, 1));
    };
  };
  for (size_t c = 0; c < 3; ++c) {
    Powers all;
    for (size_t i = 0; i < images.size(); ++i) {
      const Powers found = powers_of(images[i].layers[c].plane, weights, loose_in(i));
      all.loose += found.loose;
      all.fixed += found.fixed;
    }
    const auto scale = static_cast<float>((whole[c] - all.fixed) / all.loose);
    if (!(scale > 0.5f && scale < 2.0f)) continue;
    for (size_t i = 0; i < images.size(); ++i) {
      if (by_points[i]) scale_texels(scale, loose_in(i), images[i].layers[c].plane);
    }
  }
}

bool is_side(CubeFace face) { return face != CubeFace::py && face != CubeFace::ny; }

// Texels that are finer than the source's would show these as boxes: then all faces are looked up
// at points, else only those where meridians are no columns.
void average_images(const Layers& latlong, const SphereGrid& grid, std::vector<Layers>& images) {
  const double source_texels = source_texels_of(grid, latlong.size);
  const Points points = make_points(latlong, grid, source_texels);
  const bool sides_apart =
      grid.layout == SphereLayout::Cube && !grid.at_nodes && source_texels >= 1;
  if (sides_apart) average_over_sides(color_planes(latlong), grid.rotate_deg / 360, images);
  std::vector<bool> by_points;
  for (size_t i = 0; i < images.size(); ++i) {
    by_points.push_back(!sides_apart || !is_side(static_cast<CubeFace>(i)));
    if (by_points[i]) average_rows(points, grid, static_cast<int>(i), images[i]);
  }
  if (!grid.at_nodes) keep_power(mean_radiance(latlong), grid, points.near_hot, by_points, images);
}

}  // namespace

std::vector<Layers> average_over_texels(const Layers& latlong, const SphereGrid& grid) {
  std::vector<Layers> images = blank_images(grid);
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
