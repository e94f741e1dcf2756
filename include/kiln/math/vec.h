// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "kiln/math/wide.h"

namespace kiln {

/// A point or pair in the plane; of any number type.
template <class F>
struct Vec2 {
  F x{}, y{};
};

/// A direction, position or colour; of any number type.
template <class F>
struct Vec3 {
  F x{}, y{}, z{};

  Vec3 operator-() const { return {-x, -y, -z}; }
  friend Vec3 operator+(const Vec3& a, const Vec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Vec3 operator-(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Vec3 operator*(const Vec3& a, const Vec3& b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
  friend Vec3 operator*(const Vec3& a, F s) { return {a.x * s, a.y * s, a.z * s}; }
  friend Vec3 operator*(F s, const Vec3& a) { return a * s; }
  Vec3& operator+=(const Vec3& b) { return *this = *this + b; }
};

template <class F>
F dot(const Vec3<F>& a, const Vec3<F>& b) {
  return fma(a.x, b.x, fma(a.y, b.y, a.z * b.z));
}

template <class F>
Vec3<F> cross(const Vec3<F>& a, const Vec3<F>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

template <class F>
F length(const Vec3<F>& v) {
  return sqrt(dot(v, v));
}

/// Unit vector along v; v must not be zero.
template <class F>
Vec3<F> normalize(const Vec3<F>& v) {
  return v * (F(1) / length(v));
}

template <class F>
Vec3<F> select(const MaskOf<F>& mask, const Vec3<F>& a, const Vec3<F>& b) {
  return {select(mask, a.x, b.x), select(mask, a.y, b.y), select(mask, a.z, b.z)};
}

template <class F>
F max_component(const Vec3<F>& v) {
  return max(v.x, max(v.y, v.z));
}

/// Luminance of a linear Rec.709 colour.
template <class F>
F luminance(const Vec3<F>& c) {
  return fma(F(0.2126), c.x, fma(F(0.7152), c.y, F(0.0722) * c.z));
}

}  // namespace kiln
