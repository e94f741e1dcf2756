// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include "kiln/io/image_file.h"

/// The face of the module that holds OpenImageIO: bytes of a file <-> rows of samples. The module
/// opens no file, so paths, publishing and full disks stay on this side of the seam. Only plain
/// types cross it and no exception does; what failed is told by last_error() of the same thread.
namespace kiln::io::module {

/// The module's file, in the folder lib/kiln beside bin, and its one symbol.
inline constexpr char file_name[] = "kiln_openimageio.so";
inline constexpr char entry_name[] = "kiln_openimageio";
/// Changes whenever anything below does.
inline constexpr int face_version = 3;

struct Reader;
struct Writer;

struct StoredImage {
  int width = 0;
  int height = 0;
  int channels = 0;
  PixelType type = PixelType::Uint8;  ///< of the samples in rows
  int block_rows = 1;                 ///< read_rows wants multiples of it at the front
  int orientation = 1;                ///< EXIF's number
  int alpha_channel = -1;             ///< none
  int premultiplied = 0;              ///< 1: colour is stored times alpha
};

struct Attribute {
  const char* name;
  const char* text;
};

struct WrittenImage {
  const char* format = nullptr;  ///< OpenImageIO's name
  int width = 0;
  int height = 0;
  int channels = 0;
  PixelType type = PixelType::Uint8;
  int alpha_channel = -1;
  int fast = 0;                      ///< 1: rather packed quickly than small
  const Attribute* texts = nullptr;  ///< metadata
  int text_count = 0;
};

/// Takes the bytes of a file as they come; what is written may be overwritten.
struct Sink {
  void* self = nullptr;
  void (*write)(void* self, uint64_t place, const void* bytes, size_t count) = nullptr;
};

struct Face {
  int version;
  /// @param bytes  must outlive the reader  @return nullptr on failure
  Reader* (*open)(const char* format, const void* bytes, size_t count, StoredImage* stored);
  const char* (*channel_name)(const Reader*, int channel);
  /// The n-th piece of text metadata, or a name of nullptr.
  Attribute (*text)(Reader*, int n);
  bool (*read_rows)(Reader*, int first, int count, void* samples);
  void (*close)(Reader*);

  Writer* (*create)(const WrittenImage*, const Sink*);
  bool (*write_rows)(Writer*, int first, int count, const void* samples);
  /// Completes the file.
  bool (*finish)(Writer*);
  void (*drop)(Writer*);

  const char* (*last_error)();
};

using Entry = const Face* (*)();

}  // namespace kiln::io::module
