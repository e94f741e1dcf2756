// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "kiln/store/byte_stream.h"

namespace kiln::io {

/// Directories of a TIFF, classic or big (whose places are 64 bits wide), little-endian.
/// @source Adobe, "TIFF 6.0", section 2; AWare Systems, "BigTIFF File Format"
class TiffDirectories {
 public:
  /// Writes the header. @param big  whether the file may grow beyond 4 GiB
  TiffDirectories(ByteStream& out, bool big);

  void add_shorts(uint16_t tag, const std::vector<uint16_t>& values);
  void add_long(uint16_t tag, uint32_t value);
  /// As wide as the file's places.
  void add_places(uint16_t tag, const std::vector<uint64_t>& values);
  void add_text(uint16_t tag, std::string_view text);
  /// Writes the directory of what was added since the last, and links it behind that.
  void write();

 private:
  struct Field {
    uint16_t type = 0;
    uint64_t count = 0;
    std::string bytes;
  };
  size_t place_bytes() const { return big_ ? 8 : 4; }
  void begin_at_even_place();

  ByteStream& out_;
  bool big_;
  uint64_t link_;  ///< where the place of the next directory is to stand
  std::map<uint16_t, Field> fields_;
};

}  // namespace kiln::io
