// SPDX-License-Identifier: Apache-2.0
#include "kiln/material/anisotropy.h"

#include <algorithm>
#include <cmath>

namespace kiln {
namespace {

constexpr float burley = 0.9f;
constexpr float least_ratio = 1.0f - burley * most_anisotropic;  // of alpha_y to alpha_x

}  // namespace

LobeWidths anisotropic_widths(LobeShape shape) noexcept {
  const float a = std::clamp(shape.anisotropy, 0.0f, most_anisotropic);
  const float aspect = std::sqrt(1.0f - burley * a);
  const float alpha = shape.roughness * shape.roughness;
  return {alpha / aspect, alpha * aspect};
}

LobeShape lobe_shape(LobeWidths widths) noexcept {
  const float product = std::max(widths.x * widths.y, 0.0f);
  const float ratio = widths.x > 0.0f ? std::clamp(widths.y / widths.x, least_ratio, 1.0f) : 1.0f;
  return {std::sqrt(std::sqrt(product)), (1.0f - ratio) / burley};
}

LobeShape lobe_shape(AnisotropyEncoding encoding, float roughness, float strength) noexcept {
  const float alpha = roughness * roughness;
  switch (encoding) {
    case AnisotropyEncoding::Burley:
      break;
    case AnisotropyEncoding::Gltf:
      return lobe_shape({alpha + (1.0f - alpha) * strength * strength, alpha});
    case AnisotropyEncoding::OpenPbr: {
      const float ratio = std::max(1.0f - strength, least_ratio);
      const float x = alpha * std::sqrt(2.0f / (1.0f + ratio * ratio));
      return lobe_shape({x, ratio * x});
    }
  }
  return {roughness, strength};
}

}  // namespace kiln
