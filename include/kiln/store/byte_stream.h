// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace kiln {

/// A file that is written piece by piece.
///
/// It remembers the first failure and ignores what comes after, until check() or close() tell:
/// libraries that write through it do so in destructors as well, which cannot report a full disk.
class ByteStream {
 public:
  /// Makes the file, or empties it.
  /// @param shown_path  the name that messages give it
  ByteStream(const std::filesystem::path& path, std::filesystem::path shown_path);
  ~ByteStream();
  ByteStream(const ByteStream&) = delete;
  ByteStream& operator=(const ByteStream&) = delete;

  /// Writes at the position, which moves on.
  void append(std::string_view bytes);
  uint64_t position() const { return position_; }
  /// The next append() overwrites what lies there.
  void seek(uint64_t position) { position_ = position; }
  /// Puts bytes in front of what lies at `place`; the position moves on with its surroundings.
  /// @valid place <= position(), behind which lies nothing
  void insert(uint64_t place, std::string_view bytes);

  /// @error Fault::Output with path and reason, when anything failed so far
  void check() const;
  /// Nothing may be written any more. @error as check()
  void close();

 private:
  void flush();
  void write_at(uint64_t place, std::string_view bytes);
  void move_back(uint64_t first, uint64_t end, uint64_t distance);
  bool read_at(uint64_t place, std::string& bytes);

  std::filesystem::path shown_path_;
  int descriptor_ = -1;
  int reason_ = 0;  // errno of the first failure
  uint64_t position_ = 0;
  std::string pending_;  // not in the file yet
  uint64_t pending_at_ = 0;
};

}  // namespace kiln
