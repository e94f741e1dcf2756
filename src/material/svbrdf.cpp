// SPDX-License-Identifier: Apache-2.0
#include "kiln/material/svbrdf.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "anisotropy_mips.h"
#include "kiln/image/resample.h"
#include "kiln/material/normals.h"

namespace kiln {
namespace {

std::array<Plane, 3> halve_each(const std::array<Plane, 3>& planes) {
  return {halve(planes[0]), halve(planes[1]), halve(planes[2])};
}

// The slope variance of the facets is alpha^2 / 2 per axis (Beckmann), and variances are what
// averages over a footprint:
//
//     alpha'^2 = mean alpha^2,   alpha = r^2   =>   r' = (mean r^4)^(1/4)
Plane halve_roughness(const Plane& roughness) {
  Plane alpha_squared(roughness.size());
  for (int y = 0; y < roughness.height(); ++y) {
    const float* r = roughness.row(y);
    float* out = alpha_squared.row(y);
    for (int x = 0; x < roughness.width(); ++x) {
      const float alpha = r[x] * r[x];
      out[x] = alpha * alpha;
    }
  }
  Plane half = halve(alpha_squared);
  for (int y = 0; y < half.height(); ++y) {
    float* r = half.row(y);
    for (int x = 0; x < half.width(); ++x) r[x] = std::sqrt(std::sqrt(std::max(r[x], 0.0f)));
  }
  return half;
}

// The normal of a height field is (-dh/dx, -dh/dy, 1) normalised, and the gradient of the averaged
// height is the average of the gradients: nx/nz and ny/nz average linearly, normals do not.
std::array<Plane, 3> halve_normal(const std::array<Plane, 3>& normal) {
  const Size size = normal[0].size();
  std::array<Plane, 3> slope = {Plane(size), Plane(size), Plane()};
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const float inverse = 1.0f / std::max(normal[2].row(y)[x], least_normal_z);
      slope[0].row(y)[x] = normal[0].row(y)[x] * inverse;
      slope[1].row(y)[x] = normal[1].row(y)[x] * inverse;
    }
  }
  std::array<Plane, 3> half = {halve(slope[0]), halve(slope[1]), Plane()};
  half[2] = Plane(half[0].size());
  for (int y = 0; y < half[0].height(); ++y) {
    float* nx = half[0].row(y);
    float* ny = half[1].row(y);
    float* nz = half[2].row(y);
    for (int x = 0; x < half[0].width(); ++x) {
      nz[x] = 1.0f / std::sqrt(nx[x] * nx[x] + ny[x] * ny[x] + 1.0f);
      nx[x] *= nz[x];
      ny[x] *= nz[x];
    }
  }
  return half;
}

}  // namespace

Svbrdf halve(const Svbrdf& svbrdf) {
  Svbrdf half;
  half.name = svbrdf.name;
  half.wrap = svbrdf.wrap;
  half.diffuse_color = halve_each(svbrdf.diffuse_color);
  half.f0 = halve_each(svbrdf.f0);
  if (svbrdf.anisotropy.empty()) {
    half.roughness = halve_roughness(svbrdf.roughness);
  } else {
    halve_anisotropic(svbrdf, half);
  }
  half.normal = halve_normal(svbrdf.normal);
  half.ambient_occlusion = halve(svbrdf.ambient_occlusion);
  half.size = half.roughness.size();
  return half;
}

std::vector<Svbrdf> mip_chain(Svbrdf svbrdf) {
  std::vector<Svbrdf> chain;
  chain.push_back(std::move(svbrdf));
  while (chain.back().size != Size{1, 1}) chain.push_back(halve(chain.back()));
  return chain;
}

}  // namespace kiln
