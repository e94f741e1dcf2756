// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "kiln/math/vec.h"
#include "kiln/math/wide.h"

namespace kiln {

/// A texel of the metal-rough workflow; its dielectric reflects 4 %.
template <class F>
struct MetalRough {
  Vec3<F> base;
  F metallic;
};

inline constexpr double dielectric_f0 = 0.04;

namespace metalness {

/// The brightness that metalness is solved for.
template <class F>
F perceived(const Vec3<F>& c) {
  return sqrt(F(0.299) * c.x * c.x + F(0.587) * c.y * c.y + F(0.114) * c.z * c.z);
}

/// Root of a m^2 + (d + s - 2 a) m + (a - s), a the reflectance of the dielectric: what diffuse
/// d = base (1 - m) and F0 s = lerp(a, base, m) come to when base is eliminated.
template <class F>
F solved(F d, F s) {
  const F a(dielectric_f0);
  if (s < a) return F(0);
  const F b = d + s - F(2) * a, c = a - s;
  const F root = sqrt(max(b * b - F(4) * a * c, F(0)));
  return clamp((root - b) / (F(2) * a), F(0), F(1));
}

template <class F>
Vec3<F> blended(const Vec3<F>& of_diffuse, const Vec3<F>& of_specular, F m) {
  const auto channel = [m](F x, F y) { return clamp(lerp(x, y, m * m), F(0), F(1)); };
  return {channel(of_diffuse.x, of_specular.x), channel(of_diffuse.y, of_specular.y),
          channel(of_diffuse.z, of_specular.z)};
}

template <class F>
MetalRough<F> with_base(const Vec3<F>& diffuse, const Vec3<F>& f0, F m) {
  const F left = max(F(1) - m, F(1e-6));
  const Vec3<F> of_diffuse = diffuse * (F(1) / left);
  const F dielectric = F(dielectric_f0) * (F(1) - m);
  const Vec3<F> of_specular =
      Vec3<F>{f0.x - dielectric, f0.y - dielectric, f0.z - dielectric} * (F(1) / max(m, F(1e-6)));
  return {blended(of_diffuse, of_specular, m), m};
}

}  // namespace metalness

/// Diffuse colour and F0, as they leave the surface, as base colour and metalness. Exact where one
/// base colour and one metalness made them.
template <class F>
MetalRough<F> exact_metalness(const Vec3<F>& diffuse, const Vec3<F>& f0) {
  return metalness::with_base(
      diffuse, f0, metalness::solved(metalness::perceived(diffuse), metalness::perceived(f0)));
}

/// The same for the diffuse colour of KHR_materials_pbrSpecularGlossiness, which that extension
/// multiplies by 1 - max(specular), and for viewers that multiply base by 0.96.
/// @source KhronosGroup, glTF pull request 1106
template <class F>
MetalRough<F> khronos_metalness(const Vec3<F>& diffuse, const Vec3<F>& f0) {
  const F left = F(1) - max(f0.x, max(f0.y, f0.z));
  return exact_metalness(diffuse * (left / F(1 - dielectric_f0)), f0);
}

}  // namespace kiln
