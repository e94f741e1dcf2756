// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

namespace kiln::io {

using Bytes = std::vector<uint8_t>;
using ByteView = std::span<const uint8_t>;

/// The first bytes of a file, at most `count`.
/// @error Fault::Input when it is missing, a folder, empty or may not be read
Bytes first_bytes(const std::filesystem::path& path, size_t count);

/// The whole file. @error as first_bytes
Bytes all_bytes(const std::filesystem::path& path);

/// The bytes of a file while it is being read. Small files are held, so that nobody can change them
/// meanwhile; large ones are mapped, and need no memory of their own.
class FileContents {
 public:
  static constexpr size_t largest_held = size_t{64} << 20;
  /// Of a mapped file at most so much should be read before let_go().
  static constexpr size_t mapped_piece = size_t{16} << 20;

  /// @error as first_bytes
  explicit FileContents(const std::filesystem::path& path);
  ~FileContents();
  FileContents(const FileContents&) = delete;
  FileContents& operator=(const FileContents&) = delete;

  ByteView view() const { return view_; }

  /// Gives the pages of a mapped file back to the system. They return when they are read again.
  void let_go() const noexcept;

 private:
  Bytes held_;
  void* mapped_ = nullptr;
  ByteView view_;
};

}  // namespace kiln::io
