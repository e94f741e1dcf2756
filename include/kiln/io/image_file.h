// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "kiln/image/arrangement.h"
#include "kiln/image/bands.h"
#include "kiln/image/layers.h"

namespace kiln {

enum class PixelType {
  Uint8,
  Uint16,
  Half,
  Float,
  Rgb10a2,  ///< 10 bits each of R, G, B and 2 of A in 32 bits; A is 1 where the image has none
  /// 8 bits each of R, G, B and a common divisor: value = (c / 255)^2.2 / (a / 255), as Babylon.js
  /// decodes it. The largest channel decides a: the largest a with value * a / 255 <= 1, since the
  /// step of a value, 2.2 / 255 (value a / 255)^(1.2/2.2) / (a / 255), shrinks as a grows. Within
  /// [0,1] a is 255 throughout, so such a file may also be filtered before it is decoded.
  Rgbd8,
  /// Floats without sign in 32 bits: 11 bits of R (lowest) and of G, 10 of B, each with 5 bits of
  /// exponent (bias 15) above 6, 6 and 5 of mantissa. Up to 65024, 65024 and 64512, in steps of
  /// 1.6 %, 1.6 % and 3.1 % of a power of two.
  B10g11r11,
  /// Three mantissas of 9 bits, R lowest, and one exponent of 5 for all, in 32 bits. Up to 65408;
  /// the step of all three is 1 part in 256 to 512 of the largest of them.
  E5b9g9r9,
};
/// "uint8", "uint16", "half", "float", "rgb10a2", "rgbd8", "b10g11r11", "e5b9g9r9"
std::string_view pixel_type_name(PixelType type);

/// Metadata "name" -> text.
using Attributes = std::vector<std::pair<std::string, std::string>>;

/// What a file says of itself.
struct FileFacts {
  std::string format;  ///< "openexr", "png", "jpeg", "hdr", "tiff", ...; told by the contents
  Size size;           ///< as returned: the display window, after orientation
  std::vector<std::string> channels;  ///< R G B (or Y), A first; layers keep full names
  /// The smallest of the first five that holds what is stored.
  PixelType type = PixelType::Uint8;
  /// As tagged by the file, never trusted for data: a name of the built-in colour configuration,
  /// or "icc: DESCRIPTION". Empty when the file does not say; formats' customs are not a tag.
  std::optional<std::string> color_space_tag;
  Envmap envmap = Envmap::None;    ///< what an OpenEXR file says it is
  bool node_aligned = false;       ///< an environment with samples on its borders
  Attributes attributes;           ///< text metadata, of EXR, HDR, PNG, TIFF, KTX and .env
  std::vector<std::string> notes;  ///< what had to be decided or repaired while reading
  bool stored_as_shown = true;     ///< its rows and columns are those that are stored, in order
};

struct ImageFile {
  Layers image;     ///< values as stored (integers scaled to [0,1]), alpha unassociated
  FileFacts facts;  ///< of the whole file, however many of its channels were wanted
};

struct ReadLimits {
  long long max_texels = 1LL << 28;  ///< a header that claims more is refused
  int max_channels = 256;            ///< as is one with more channels
};

/// Calls task(i) for every i below count, in any order, side by side or not.
using RunTasks = std::function<void(int count, const std::function<void(int)>& task)>;

/// The header only. @error Fault::Input, message "PATH: what is wrong"
FileFacts inspect_image(const std::filesystem::path& path);

/// Any image: OpenEXR, Radiance HDR, DDS and KTX that are not block-compressed, and .npy directly,
/// everything else (and the images within .env) through OpenImageIO, which is loaded on first use.
/// The contents decide the format, not the extension.
///
/// The display window is what is returned, with 0 where a file has no data; EXIF and HDR
/// orientation are applied. NaN and Inf are returned as stored. Of several parts or pages the first
/// is read, of mip levels the largest, of cubes and arrays the first face; a volume is its slices
/// from top to bottom. Notes say so. Colour under alpha 0 is kept, since PNG alpha is never
/// multiplied in. Alpha of OpenEXR files is returned as stored, and a note says so: the format's
/// custom is premultiplied colour, yet maps whose A is no coverage are common.
///
/// May be called from many threads at once; starts no thread of its own.
/// What is returned is all that is held, beside a few rows: files are not held themselves, except
/// small ones and JPEG.
/// @param channels  names of the channels wanted, in any order; the others are not held. Empty: all
/// @param run       with which large OpenEXR files are unpacked side by side. Empty: one after
/// another
/// @error Fault::Input when missing, empty, truncated, unreadable or too large
ImageFile read_image(const std::filesystem::path& path, const ReadLimits& limits = {},
                     const std::vector<std::string>& channels = {}, const RunTasks& run = {});

/// What a written file says about its colours, in formats that can say it (PNG).
enum class ColorTag {
  None,    ///< nothing: data, or a space that the format has no word for
  Srgb,    ///< sRGB, encoded
  Linear,  ///< Rec.709 primaries, linear
};

/// How colour is stored beside alpha in OpenEXR files; all other formats keep it straight.
enum class AlphaStorage {
  Straight,       ///< as in memory; colour under alpha 0 survives
  Premultiplied,  ///< R, G, B (or Y) times A: the custom of pictures in OpenEXR
};

/// What OpenEXR and PNG files are packed with.
enum class Packing {
  Zip,   ///< small: what pictures want
  Fast,  ///< several times faster to write: what tables want. OpenEXR is not packed at all, PNG
         ///< lightly, to within a tenth of the size
};

/// What the numbers of a table stand for, in formats that are read by people.
struct Labels {
  struct Axis {
    std::string name;
    std::vector<double> coordinates;  ///< one per column, row or slice
  };
  std::vector<Axis> axes;             ///< in the order x, y, z; empty: indices from 0
  std::vector<std::string> channels;  ///< in the order of the layers; empty: their names
};

struct WriteOptions {
  PixelType type = PixelType::Half;
  /// In formats that hold them (WritableFormat::holds_attributes).
  Attributes attributes = {};
  ColorTag color_tag = ColorTag::None;
  AlphaStorage alpha = AlphaStorage::Straight;
  /// Slices of a volume, which stand one below the other in the image. Formats without volumes
  /// hold the image as it stands.
  int depth = 1;
  Labels labels = {};
  Packing packing = Packing::Zip;
  /// With which blocks of OpenEXR files are packed side by side. Empty: one after another.
  RunTasks run = {};
};

struct WriteFacts {
  long long clamped = 0;       ///< finite values beyond the type's range that were clamped
  long long not_a_number = 0;  ///< NaN that became 0, in types that have none
  double largest_clamped = 0;  ///< largest magnitude of the clamped values
};

/// A format that write_image knows.
struct WritableFormat {
  std::string_view name;
  std::vector<std::string_view> extensions;  ///< lower case, with the dot
  std::vector<PixelType> types;              ///< the first is the format's default
  std::string_view channels;                 ///< what it holds, in words
  bool holds_attributes = false;             ///< WriteOptions::attributes, whatever their names
};
const std::vector<WritableFormat>& writable_formats();

/// The format that an extension of `path` (any case) stands for.
/// @error Fault::Usage, naming the extensions that are known
const WritableFormat& writable_format(const std::filesystem::path& path);

/// Publishes an image whole or not at all; bytes depend on nothing but the arguments (no date).
///
/// | extension   | types                                       | channels                       |
/// |-------------|---------------------------------------------|--------------------------------|
/// | .exr        | half, float (ZIP or not packed)             | any, by name                   |
/// | .hdr        | float (as RGBE)                             | 1 to 3; one is repeated, a     |
/// |             |                                             | third is 0                     |
/// | .png        | uint8, rgbd8, uint16                        | 1 to 4; two without alpha get  |
/// |             |                                             | a third of 0                   |
/// | .jpg .jpeg  | uint8                                       | 1 to 3; as .hdr                |
/// | .tif .tiff  | uint8, uint16, half, float                  | any                            |
/// | .dds .ktx2  | half, uint8, uint16, rgb10a2, rgbd8, float  | 1 to 4; three get an alpha of  |
/// |             |                                             | 1, in float they stay three    |
/// | .npy        | half, uint8, uint16, float                  | any; [h][w][c], one: [h][w]    |
/// | .csv        | float (9 digits)                            | any, by name; one entry a line |
/// | .h          | half, uint8, uint16, float                  | any; NAME[h][w][c] of C or C++ |
///
/// .dds, .ktx2, .npy, .csv and .h hold volumes (WriteOptions::depth), with [d] in front. In .h half
/// and uint16 are the bits as `unsigned short`. rgb10a2 and rgbd8 fill missing colours with 0.
///
/// Where a format has no channel names, R G B A (or Y A) are put in that order and other names are
/// taken in the order of the layers; only a layer named A is alpha, stored straight.
/// Integers are round(v * max). In half, uint, RGBE and rgbd8 finite values beyond the range are
/// clamped and counted. RGBE has no negative values, and stores 1 part in 256 of the largest of the
/// three.
/// @error Fault::Usage for an unknown extension or a type or channels that the format cannot hold,
///        Fault::Output when it cannot be written
WriteFacts write_image(const std::filesystem::path& path, const Layers& image,
                       const WriteOptions& options);

/// The same for an image that need not be held: the same bytes, and one band in memory at a time.
/// (JPEG is encoded in memory by its library.)
/// @error as write_image, and what making a band throws
WriteFacts write_bands(const std::filesystem::path& path, const ImageBands& image,
                       const WriteOptions& options);

/// The same for a file that grows while others do. It appears when it is finished.
class ImageWriter {
 public:
  /// @param names  of the layers of every band
  /// @error as write_image
  ImageWriter(const std::filesystem::path& path, Size size, const std::vector<std::string>& names,
              const WriteOptions& options);
  ~ImageWriter();
  ImageWriter(const ImageWriter&) = delete;
  ImageWriter& operator=(const ImageWriter&) = delete;

  /// Rows below those before. @error as write_image
  void add(const Layers& band);
  /// @error Fault::Output
  WriteFacts finish();

 private:
  struct Unfinished;
  std::unique_ptr<Unfinished> unfinished_;
};

/// What a reader of a file of this type gets: each value rounded, clamped or shared an exponent as
/// the type has it. The difference to `image` is the error of the encoding. Layers keep their
/// names and order.
/// @error Fault::Usage for more channels than the type has (b10g11r11, e5b9g9r9, rgbd8: R G B, or
///        one or two; rgb10a2: four)
Layers coded(const Layers& image, PixelType type);

/// The same for Radiance HDR: three layers that share an exponent.
/// @error Fault::Usage for more or fewer layers
Layers coded_as_hdr(const Layers& image);

}  // namespace kiln
