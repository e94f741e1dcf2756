// SPDX-License-Identifier: Apache-2.0
#include "picture.h"

#include <algorithm>
#include <cmath>

#include "kiln/material/anisotropy.h"

namespace kiln {
namespace {

constexpr double position_x[subpixels] = {0.375, 0.875, 0.125, 0.625};
constexpr double position_y[subpixels] = {0.125, 0.375, 0.625, 0.875};

double radius_of(Size picture) { return 0.48 * std::min(picture.width, picture.height); }

int wrap(int i, int n) {
  const int rest = i % n;
  return rest < 0 ? rest + n : rest;
}

// Adds weight times the bilinear value of each plane of the range at (u, v), repeating.
void add_bilinear(const Svbrdf& maps, double u, double v, double weight, const PlaneRange& range,
                  float* values) {
  const double x = u * maps.size.width - 0.5, y = v * maps.size.height - 0.5;
  const int left = static_cast<int>(std::floor(x)), top = static_cast<int>(std::floor(y));
  const double tx = x - left, ty = y - top;
  const int x0 = wrap(left, maps.size.width), x1 = wrap(left + 1, maps.size.width);
  const int y0 = wrap(top, maps.size.height), y1 = wrap(top + 1, maps.size.height);
  const auto planes = planes_of(maps);
  for (int p = range.first; p < range.last; ++p) {
    if (planes[p]->empty()) continue;
    const float *a = planes[p]->row(y0), *b = planes[p]->row(y1);
    const double value = std::lerp(std::lerp(a[x0], a[x1], tx), std::lerp(b[x0], b[x1], tx), ty);
    values[p] += static_cast<float>(weight * value);
  }
}

// Anisotropy becomes a vector of twice its angle, which can be averaged: lobes at angle and angle +
// pi are the same.
void turn_into_vectors(Svbrdf& maps) {
  if (maps.anisotropy.empty()) return;
  if (maps.anisotropy_angle.empty()) maps.anisotropy_angle = Plane(maps.size);
  for (int y = 0; y < maps.size.height; ++y) {
    float *a = maps.anisotropy.row(y), *angle = maps.anisotropy_angle.row(y);
    for (int x = 0; x < maps.size.width; ++x) {
      const float strength = std::clamp(a[x], 0.0f, most_anisotropic);
      a[x] = strength * std::cos(2 * angle[x]);
      angle[x] = strength * std::sin(2 * angle[x]);
    }
  }
}

template <class F>
Vec3<F> load_vector(const std::array<std::array<float, lane_count<F>>, 3>& v) {
  return {load_lanes<F>(v[0].data()), load_lanes<F>(v[1].data()), load_lanes<F>(v[2].data())};
}

template <class F>
void put(std::array<std::array<float, lane_count<F>>, 3>& to, int lane, const Vec3<double>& v) {
  to[0][lane] = static_cast<float>(v.x);
  to[1][lane] = static_cast<float>(v.y);
  to[2][lane] = static_cast<float>(v.z);
}

std::vector<Svbrdf> levels_of(Svbrdf maps, bool exact) {
  std::vector<Svbrdf> levels;
  if (exact) {
    levels.push_back(std::move(maps));
  } else {
    levels = mip_chain(std::move(maps));
  }
  return levels;
}

Vec3<float> narrowed(const Vec3<double>& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

template <class F>
Vec3<F> widened(const Vec3<float>& v) {
  return {F(v.x), F(v.y), F(v.z)};
}

}  // namespace

Picture::Picture(Svbrdf maps, const Options& options)
    : options_(options),
      exact_(!options.ball && options.size == maps.size),
      levels_(levels_of(std::move(maps), exact_)),
      cos_rotate_(std::cos(options.rotate_deg * pi / 180)),
      sin_rotate_(std::sin(options.rotate_deg * pi / 180)) {
  for (Svbrdf& level : levels_) turn_into_vectors(level);
  const auto turned = [&](const Vec3<double>& w) { return narrowed(to_environment(w)); };
  plane_ = {{turned({1, 0, 0}), turned({0, 1, 0}), turned({0, 0, 1})}, turned(options.to_viewer)};
}

// Turning the environment one way is turning everything else the other way.
Vec3<double> Picture::to_environment(const Vec3<double>& w) const {
  return {w.x * cos_rotate_ - w.z * sin_rotate_, w.y, w.x * sin_rotate_ + w.z * cos_rotate_};
}

Vec3<double> Picture::from_environment(const Vec3<double>& w) const {
  return {w.x * cos_rotate_ + w.z * sin_rotate_, w.y, w.z * cos_rotate_ - w.x * sin_rotate_};
}

// Half a level finer than the footprint of a pixel is read, which on a ball is least in its middle.
Size Picture::texels_read(bool ball, Size size) {
  const double finer = std::sqrt(2.0);
  const auto counted = [&](double texels) { return static_cast<int>(std::ceil(finer * texels)); };
  if (!ball) return {counted(size.width), counted(size.height)};
  const int around = counted(pi * radius_of(size));
  return {around, around};
}

double Picture::radius() const { return radius_of(options_.size); }

float Picture::coverage(int x, int y) const {
  if (!options_.ball) return 1;
  const double dx = x + 0.5 - 0.5 * options_.size.width, dy = y + 0.5 - 0.5 * options_.size.height;
  return static_cast<float>(std::clamp(radius() - std::hypot(dx, dy) + 0.5, 0.0, 1.0));
}

// The frame's x axis runs along growing u (longitude), its y axis toward the upper pole; both are
// defined everywhere, for longitude is, at the poles too.
Picture::Spot Picture::spot_of_ball(double px, double py) const {
  double x = (px - 0.5 * options_.size.width) / radius();
  double y = (0.5 * options_.size.height - py) / radius();
  const double r = std::hypot(x, y);
  constexpr double rim = 0.9995;
  if (r > rim) {
    x *= rim / r;
    y *= rim / r;
  }
  return spot_on_ball({x, y, std::sqrt(1 - x * x - y * y)});
}

Picture::Spot Picture::spot_on_ball(const Vec3<double>& normal) const {
  const double longitude = std::atan2(normal.x, normal.z);
  const double latitude = std::asin(std::clamp(normal.y, -1.0, 1.0));
  const double off_axis = std::hypot(normal.x, normal.z);
  const Vec3<double> along = off_axis > 0
                                 ? Vec3<double>{normal.z / off_axis, 0, -normal.x / off_axis}
                                 : Vec3<double>{1, 0, 0};
  // Two repeats around 2 pi, so that the map's aspect on the ball is 1 : 1 at the equator.
  const double u = longitude / pi + 0.5, v = 0.5 - latitude / pi;
  const Size map = levels_.front().size;
  const double texels_per_pixel = std::max(map.width, map.height) / (pi * radius());
  // Between the shorter and the longer axis of the pixel's footprint, which is 1 to 1/z. What is
  // seen through the ball has no such footprint; it is read as if seen as steeply from behind.
  const double tilt = std::max(std::abs(normal.z), 0.03);
  const double level = std::log2(std::max(texels_per_pixel / std::sqrt(tilt), 1.0));
  return {u, v, level, {along, cross(normal, along), normal}};
}

void Picture::read(const Spot& spot, const PlaneRange& planes, float* values) const {
  const double last = static_cast<double>(levels_.size() - 1);
  // Half a level finer: the positions inside a pixel average what is left.
  const double at = std::clamp(spot.level - 0.5, 0.0, last);
  const auto fine = static_cast<size_t>(at);
  const double blend = at - static_cast<double>(fine);
  std::fill(values, values + svbrdf_planes, 0.0f);
  add_bilinear(levels_[fine], spot.u, spot.v, 1 - blend, planes, values);
  if (blend > 0) add_bilinear(levels_[fine + 1], spot.u, spot.v, blend, planes, values);
}

// Lanes beyond the last texel repeat it.
template <class F>
void Picture::fill_texels(int x, int y, TexelBlock<F>& texels) const {
  constexpr int lanes = lane_count<F>;
  const auto planes = planes_of(levels_.front());
  const int inside = std::min(lanes, options_.size.width - x);
  for (size_t p = 0; p < planes.size(); ++p) {
    if (planes[p]->empty()) {
      texels[p].fill(0.0f);
      continue;
    }
    const float* row = planes[p]->row(y) + x;
    if (inside == lanes) {
      std::copy_n(row, lanes, texels[p].begin());
    } else {
      for (int lane = 0; lane < lanes; ++lane) texels[p][lane] = row[std::min(lane, inside - 1)];
    }
  }
}

template <class F>
void Picture::fill(int x, int y, int position, TexelBlock<F>& texels,
                   Placement<F>& placement) const {
  constexpr int lanes = lane_count<F>;
  if (exact_) {
    fill_texels<F>(x, y, texels);
    placement.frame = {widened<F>(plane_.frame.x), widened<F>(plane_.frame.y),
                       widened<F>(plane_.frame.z)};
    placement.to_viewer = widened<F>(plane_.to_viewer);
    return;
  }
  std::array<std::array<float, lanes>, 3> along, up, normal;
  const Frame<double> plane{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const Svbrdf& maps = levels_.front();
  const double minified = std::max(static_cast<double>(maps.size.width) / options_.size.width,
                                   static_cast<double>(maps.size.height) / options_.size.height);
  for (int lane = 0; lane < lanes; ++lane) {
    const int column = std::min(x + lane, options_.size.width - 1);
    float values[svbrdf_planes];
    const double px = column + position_x[position], py = y + position_y[position];
    const Spot spot = options_.ball ? spot_of_ball(px, py)
                                    : Spot{px / options_.size.width, py / options_.size.height,
                                           std::log2(std::max(minified, 1.0)), plane};
    read(spot, {}, values);
    for (int p = 0; p < svbrdf_planes; ++p) texels[p][lane] = values[p];
    put<F>(along, lane, to_environment(spot.frame.x));
    put<F>(up, lane, to_environment(spot.frame.y));
    put<F>(normal, lane, to_environment(spot.frame.z));
  }
  placement.frame = {load_vector<F>(along), load_vector<F>(up), load_vector<F>(normal)};
  const Vec3<double> viewer =
      to_environment(options_.ball ? Vec3<double>{0, 0, 1} : options_.to_viewer);
  placement.to_viewer = {F(static_cast<float>(viewer.x)), F(static_cast<float>(viewer.y)),
                         F(static_cast<float>(viewer.z))};
}

template <class F>
void Picture::fill_on_ball(const Vec3<F>& normal, TexelBlock<F>& texels, Frame<F>& frame) const {
  constexpr int lanes = lane_count<F>;
  std::array<std::array<float, lanes>, 3> along, up, at;
  store_lanes(at[0].data(), normal.x);
  store_lanes(at[1].data(), normal.y);
  store_lanes(at[2].data(), normal.z);
  for (int lane = 0; lane < lanes; ++lane) {
    const Spot spot = spot_on_ball(from_environment({at[0][lane], at[1][lane], at[2][lane]}));
    float values[svbrdf_planes];
    read(spot, relief_planes, values);
    for (int p = 0; p < svbrdf_planes; ++p) texels[p][lane] = values[p];
    put<F>(along, lane, to_environment(spot.frame.x));
    put<F>(up, lane, to_environment(spot.frame.y));
  }
  frame = {load_vector<F>(along), load_vector<F>(up), normal};
}

template void Picture::fill_on_ball<WideFloat>(const Vec3<WideFloat>&, TexelBlock<WideFloat>&,
                                               Frame<WideFloat>&) const;
template void Picture::fill<float>(int, int, int, TexelBlock<float>&, Placement<float>&) const;
template void Picture::fill<WideFloat>(int, int, int, TexelBlock<WideFloat>&,
                                       Placement<WideFloat>&) const;

}  // namespace kiln
