// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string_view>

namespace kiln {

/// Widths of a microfacet lobe: along the wider axis and across it.
struct LobeWidths {
  float x = 1;
  float y = 1;
};

/// The same as textures hold it.
struct LobeShape {
  float roughness = 1;   ///< perceptual, of the mean width: r^4 = alpha_x alpha_y
  float anisotropy = 0;  ///< 0 to `most_anisotropic`
};

/// The strongest that an SVBRDF holds: alpha_y = alpha_x / 100.
inline constexpr float most_anisotropic = 1.1f;

/// What `Svbrdf::roughness` and `Svbrdf::anisotropy` mean:
///
///     aspect = sqrt(1 - 0.9 a),   alpha_x = r^2 / aspect,   alpha_y = r^2 aspect
///
/// @return   not clamped to [1e-4, 1]: that is left to the lobe, as to_alpha() does it
/// @valid    roughness in [0,1]; anisotropy is clamped to [0, most_anisotropic]
/// @source   Burley 2012
LobeWidths anisotropic_widths(LobeShape shape) noexcept;

/// The inverse; stronger anisotropy than an SVBRDF holds keeps the mean width.
LobeShape lobe_shape(LobeWidths widths) noexcept;

/// What a stored strength of anisotropy stands for, with alpha = r^2:
///
///     burley   as anisotropic_widths()
///     gltf     alpha_x = alpha + (1 - alpha) s^2,          alpha_y = alpha
///     openpbr  alpha_x = alpha sqrt(2 / (1 + (1 - s)^2)),  alpha_y = (1 - s) alpha_x
///
/// @source Burley 2012; KHR_materials_anisotropy; OpenPBR 1.1
enum class AnisotropyEncoding { Burley, Gltf, OpenPbr };
inline constexpr std::array<std::string_view, 3> anisotropy_encoding_names = {"burley", "gltf",
                                                                              "openpbr"};

/// Roughness and strength as another model means them, as an SVBRDF holds them.
/// @valid roughness and strength in [0,1]
LobeShape lobe_shape(AnisotropyEncoding encoding, float roughness, float strength) noexcept;

}  // namespace kiln
