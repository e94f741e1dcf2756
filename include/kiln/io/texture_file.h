// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

#include "kiln/image/texture.h"
#include "kiln/io/image_file.h"

namespace kiln {

/// What each level is packed with, without loss, on top of its pixel type.
enum class Supercompression {
  None,
  Zstd,  ///< Zstandard; KTX 2 only
};

/// Where the samples of an environment lie.
enum class Samples {
  Texels,  ///< at texel centres, as graphics libraries sample them
  Nodes,   ///< on the borders too, as OpenEXR's `envmap` wants them: the outermost lie on the edges
};

/// Irradiance over pi as a quadratic polynomial of the normal n, R G B each, in the axes of the
/// cube's faces:
///
///     x nx + y ny + z nz + xx nx^2 + yy ny^2 + zz nz^2 + yz ny nz + zx nz nx + xy nx ny
struct IrradiancePolynomial {
  using Color = std::array<double, 3>;
  Color x{}, y{}, z{};
  Color xx{}, yy{}, zz{};
  Color yz{}, zx{}, xy{};
};

struct TextureWriteOptions {
  PixelType type = PixelType::Half;
  Supercompression supercompression = Supercompression::None;
  /// Nodes: OpenEXR only, and cubes in OpenEXR must be so.
  Samples samples = Samples::Texels;
  Attributes attributes = {};  ///< in formats that hold them (WritableTexture::holds_attributes)
  ColorTag color_tag = ColorTag::None;  ///< Linear: Rec.709 primaries are stated, by KTX 2
  /// What .env says besides; other formats have no place for it.
  std::optional<IrradiancePolynomial> irradiance = std::nullopt;
  double lod_generation_scale = 0.8;  ///< level = scale log2(width alpha) in Babylon.js
};

/// A format that write_texture knows.
struct WritableTexture {
  std::string_view name;
  std::string_view extension;    ///< lower case, with the dot
  std::vector<PixelType> types;  ///< the first is the format's default
  std::string_view shapes;       ///< what it holds, in words
  bool holds_images = true;      ///< besides cubes
  bool holds_attributes = false;
  bool supercompresses = false;
};
const std::vector<WritableTexture>& writable_textures();

/// The format that the extension of `path` (any case) stands for.
/// @error Fault::Usage, naming the extensions that are known
const WritableTexture& writable_texture(const std::filesystem::path& path);

/// Publishes a texture with all its levels whole or not at all; bytes depend on nothing but the
/// arguments.
///
/// | extension | types                              | holds |
/// |-----------|------------------------------------|------------------------------------------------|
/// | .ktx2     | half, float, b10g11r11, e5b9g9r9   | cubes and images, also packed with Zstandard
/// | | .ktx      | half, float, b10g11r11, e5b9g9r9   | cubes and images (KTX 1) | | .dds      |
/// half, float, b10g11r11, e5b9g9r9   | cubes and images (header of DirectX 10)        | | .exr |
/// half, float                        | images; environments with samples at nodes     | | .env |
/// rgbd8                              | cubes of 2^n texels down to 1 (Babylon.js)     |
///
/// Channels are R G B, or one or two; in half and float also R G B A, and three get an alpha of 1,
/// but in .exr, which holds any by name. Rows, faces and their order are those of CubeFace (seen
/// from inside, +Y up, the first row at the top); each format's own convention is made here:
///
/// * .ktx2, .ktx, .dds hold the faces as they come. In .ktx, b10g11r11 has the OpenGL type 0x8c3a
///   that Filament's tools write and its loader expects, where the specification has 0x8c3b; the
///   attribute "sh" is what Filament takes for spherical harmonics.
/// * .env holds the rows of each face from the bottom, as Babylon.js turns images on loading.
/// * .exr holds tiles of one mip-mapped part. With Samples::Nodes it is marked as an environment
///   (`envmap`): images as lat-long, 2 n x n; a cube as its faces one below the other, those of the
///   sides mirrored left-right and those of top and bottom upside down, which is OpenEXR's view
///   from outside. The format demands levels down to 1 x 1: what the texture lacks is averaged from
///   its last level, and the attribute "kiln:levels" says how many are its own.
///
/// @error Fault::Usage for an unknown extension, or what the format cannot hold: a type, channels,
///        a shape, sizes, samples, supercompression, names of attributes.
///        Fault::Output when it cannot be written
WriteFacts write_texture(const std::filesystem::path& path, const Texture& texture,
                         const TextureWriteOptions& options);

struct TextureFile {
  Texture texture;  ///< rows, faces and channels as write_texture takes them
  FileFacts facts;  ///< size: of the largest level, one face; node_aligned: Samples::Nodes
  PixelType stored = PixelType::Float;  ///< how texels are coded, packed types included
  Supercompression supercompression = Supercompression::None;
  std::optional<IrradiancePolynomial> irradiance;  ///< of .env
  std::optional<double> lod_generation_scale;      ///< of .env
};

/// Every level and face of a texture: .ktx2 (also packed with Zstandard), .ktx and .dds that are
/// not block-compressed, .env, mip-mapped OpenEXR and its environments; of any other image the one
/// level that there is. The contents decide the format. Of arrays the first element is read.
///
/// @param limits  max_texels bounds the texels of all faces and levels together
/// @error Fault::Input when missing, damaged or too large, and for volumes
TextureFile read_texture(const std::filesystem::path& path, const ReadLimits& limits = {});

}  // namespace kiln
