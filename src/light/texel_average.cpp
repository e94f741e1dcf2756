// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "color_planes.h"
#include "finer.h"
#include "hot_texels.h"
#include "kiln/image/projection.h"
#include "kiln/light/angles.h"
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
constexpr double points_per_source_texel = 2.3;
constexpr double most_source_texels = 4;

/// What hot texels have above the limit, dealt out to the texels that points in them lie in.
class Spill {
 public:
  Spill(SphereLayout layout, const std::vector<Layers>& images)
      : layout_(layout), size_(images.front().size), power_(images.size()) {}

  void deal(Size source, const HotTexel& texel, const PowerLimit& limit);
  void add_to(int image, Layers& to) const;

 private:
  void add(const Vec3<double>& d, const std::array<double, 3>& power);

  SphereLayout layout_;
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
    const double phi_rad = 2 * pi * ((texel.x + (i + 0.5) / n) / source.width - 0.5);
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
  const int count =
      std::max(1, static_cast<int>(std::ceil(points_per_source_texel * source_texels / times)));
  if (times == 1) return {within_limit(latlong, limit, hot), count};
  const Layers coarser = reduced(color_planes(latlong), limit, times);
  return {LatLongTexels(coarser, coarser.size.width, Pole::AcrossByHalfATurn), count};
}

WideFloat count_up() {
  float values[lanes];
  for (int i = 0; i < lanes; ++i) values[i] = static_cast<float>(i);
  return load_lanes<WideFloat>(values);
}

// Neither is normalised, and a point's solid angle goes as one over its length cubed.
Vec3<WideFloat> point_of(SphereLayout layout, int image, WideFloat u, WideFloat v) {
  if (layout == SphereLayout::Octahedral) return octahedral_point(Vec2<WideFloat>{u, v});
  const auto face = static_cast<CubeFace>(image);
  const auto part = [&](double middle, double right, double down) {
    return fma(u, WideFloat(static_cast<float>(right)),
               fma(v, WideFloat(static_cast<float>(down)), WideFloat(static_cast<float>(middle))));
  };
  const Vec3<double> corner = cube_to_direction(face, {0, 0});
  const Vec3<double> right = cube_to_direction(face, {1, 0}) - corner;
  const Vec3<double> down = cube_to_direction(face, {0, 1}) - corner;
  return {part(corner.x, right.x, down.x), part(corner.y, right.y, down.y),
          part(corner.z, right.z, down.z)};
}

Vec2<WideFloat> in_texels(Size size, const Vec2<WideFloat>& uv) {
  return {fma(uv.x, WideFloat(static_cast<float>(size.width)), WideFloat(0.5f)),
          fma(uv.y, WideFloat(static_cast<float>(size.height)), WideFloat(0.5f))};
}

// As many texels of row y as a wide number has lanes, from texel x on.
Vec3<WideFloat> average_at(const Points& points, SphereLayout layout, Size size, int image, int x,
                           int y) {
  const auto n = static_cast<float>(points.count);
  const WideFloat step(1 / static_cast<float>(size.width));
  const WideFloat first = count_up() + WideFloat(static_cast<float>(x));
  Vec3<WideFloat> sum{WideFloat(0.0f), WideFloat(0.0f), WideFloat(0.0f)};
  WideFloat weights(0.0f);
  for (int j = 0; j < points.count; ++j) {
    const WideFloat v((static_cast<float>(y) + (static_cast<float>(j) + 0.5f) / n) /
                      static_cast<float>(size.height));
    for (int i = 0; i < points.count; ++i) {
      const WideFloat u = (first + WideFloat((static_cast<float>(i) + 0.5f) / n)) * step;
      const Vec3<WideFloat> d = point_of(layout, image, u, v);
      const WideFloat inverse = WideFloat(1.0f) / length(d);
      const WideFloat weight = inverse * inverse * inverse;
      sum +=
          points.texels.bilinear(in_texels(points.texels.size(), latlong_of(d * inverse))) * weight;
      weights += weight;
    }
  }
  return sum * (WideFloat(1.0f) / weights);
}

void average_rows(const Points& points, SphereLayout layout, int image, Layers& to) {
  for_rows(to.size.height, [&](int y) {
    for (int x = 0; x < to.size.width; x += lanes) {  // rows are padded to whole wide numbers
      const Vec3<WideFloat> value = average_at(points, layout, to.size, image, x, y);
      store_lanes(to.layers[0].plane.row(y) + x, value.x);
      store_lanes(to.layers[1].plane.row(y) + x, value.y);
      store_lanes(to.layers[2].plane.row(y) + x, value.z);
    }
  });
}

// Texels that are finer than the source's would show these as boxes: then all faces are looked up
// at points, else only those where meridians are no columns.
void average_images(const Layers& latlong, SphereLayout layout, double source_texels,
                    std::vector<Layers>& images) {
  const ColorPlanes source = color_planes(latlong);
  const double mean_share = 1.0 / static_cast<double>(area(latlong.size));
  PowerLimit limit = share_of_power(source, std::max(hot_share, hot_times_mean * mean_share));
  limit.least_solid_angle = 4 * pi * mean_share / 8;
  const std::vector<HotTexel> hot = hot_texels(source, limit);
  const Points points = make_points(latlong, limit, hot, source_texels);
  const bool sides_apart = layout == SphereLayout::Cube && source_texels >= 1;
  if (sides_apart) average_over_sides(source, limit, images);
  Spill spill(layout, images);
  for (const HotTexel& texel : hot) spill.deal(latlong.size, texel, limit);
  for (size_t i = 0; i < images.size(); ++i) {
    const auto face = static_cast<CubeFace>(i);
    if (!sides_apart || face == CubeFace::py || face == CubeFace::ny) {
      average_rows(points, layout, static_cast<int>(i), images[i]);
    }
    spill.add_to(static_cast<int>(i), images[i]);
  }
}

// Rows of the source to the widest texel of a layout.
double source_texels_of(SphereLayout layout, Size source, Size image) {
  const double widest_rad =
      layout == SphereLayout::Octahedral ? 2 * std::sqrt(3.0) / image.height : 2.0 / image.height;
  return widest_rad * source.height / pi;
}

}  // namespace

std::vector<Layers> average_over_texels(const Layers& latlong, SphereLayout layout, int size) {
  const Size extent = image_size(layout, size);
  std::vector<Layers> images;
  for (int i = 0; i < image_count(layout); ++i) {
    images.push_back(make_layers(extent, {"R", "G", "B"}));
  }
  if (layout == SphereLayout::LatLong) {
    average_over_latlong(color_planes(latlong), images.front());
    return images;
  }
  average_images(latlong, layout, source_texels_of(layout, latlong.size, extent), images);
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
