// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "kiln/image/projection.h"
#include "kiln/light/angles.h"
#include "kiln/light/latlong_texels.h"
#include "kiln/parallel/rows.h"
#include "prefilter.h"

namespace kiln {
namespace {

constexpr int lanes = lane_count<WideFloat>;

// Points per axis in a cube texel: three to a source texel at the centre of a face, where cube
// texels span the widest angle, in whole wide numbers.
int points_per_texel(Size source, int size) {
  const double source_texels = std::max(source.width / 2, source.height) / (pi / 2 * size) * 4 / pi;
  const int points = static_cast<int>(std::ceil(3 * source_texels));
  return std::clamp((points + lanes - 1) / lanes * lanes, lanes, 64);
}

WideFloat count_up() {
  float values[lanes];
  for (int i = 0; i < lanes; ++i) values[i] = static_cast<float>(i);
  return load_lanes<WideFloat>(values);
}

/// The affine map of a face: direction = middle + s right + t down.
struct FaceFrame {
  Vec3<double> middle, right, down;
};

FaceFrame frame_of(CubeFace face) {
  const Vec3<double> middle = cube_to_direction(face, {0.5, 0.5});
  return {middle, cube_to_direction(face, {1, 0.5}) - middle,
          cube_to_direction(face, {0.5, 1}) - middle};
}

Vec3<WideFloat> along(const FaceFrame& frame, WideFloat s, float t) {
  const auto part = [&](double middle, double right, double down) {
    return fma(s, WideFloat(static_cast<float>(right)),
               WideFloat(static_cast<float>(middle + down * static_cast<double>(t))));
  };
  return {part(frame.middle.x, frame.right.x, frame.down.x),
          part(frame.middle.y, frame.right.y, frame.down.y),
          part(frame.middle.z, frame.right.z, frame.down.z)};
}

// Points on a regular grid, each weighted by its solid angle (1 + s^2 + t^2)^(-3/2).
Vec3<float> average(const LatLongTexels& source, const FaceFrame& frame, Vec2<float> corner,
                    float edge, int points) {
  const WideFloat first = count_up();
  const float step = edge / static_cast<float>(points);
  const Size size = source.size();
  Vec3<WideFloat> sum{WideFloat(0.0f), WideFloat(0.0f), WideFloat(0.0f)};
  WideFloat weights(0.0f);
  for (int j = 0; j < points; ++j) {
    const float t = corner.y + step * (static_cast<float>(j) + 0.5f);
    for (int i = 0; i < points; i += lanes) {
      const WideFloat s = fma(first + WideFloat(static_cast<float>(i) + 0.5f), WideFloat(step),
                              WideFloat(corner.x));
      const Vec3<WideFloat> d = along(frame, s, t);
      const WideFloat inverse = WideFloat(1.0f) / length(d);
      const WideFloat weight = inverse * inverse * inverse;
      const Vec2<WideFloat> uv = latlong_of(d * inverse);
      const Vec2<WideFloat> at{
          fma(uv.x, WideFloat(static_cast<float>(size.width)), WideFloat(0.5f)),
          fma(uv.y, WideFloat(static_cast<float>(size.height)), WideFloat(0.5f))};
      sum += source.bilinear(at) * weight;
      weights += weight;
    }
  }
  const float inverse = 1 / xsimd::hadd(weights);
  return {xsimd::hadd(sum.x) * inverse, xsimd::hadd(sum.y) * inverse, xsimd::hadd(sum.z) * inverse};
}

}  // namespace

CubeTexels average_over_texels(const Layers& latlong, int size) {
  const LatLongTexels source(latlong, latlong.size.width, Pole::Clamped);
  const int points = points_per_texel(latlong.size, size);
  const float edge = 2.0f / static_cast<float>(size);
  CubeTexels texels(static_cast<size_t>(6 * size * size));
  for_rows(6 * size, [&](int row) {
    const FaceFrame frame = frame_of(static_cast<CubeFace>(row / size));
    for (int x = 0; x < size; ++x) {
      const Vec2<float> corner{edge * static_cast<float>(x) - 1,
                               edge * static_cast<float>(row % size) - 1};
      texels[static_cast<size_t>(row * size + x)] = average(source, frame, corner, edge, points);
    }
  });
  return texels;
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
