// SPDX-License-Identifier: Apache-2.0
#include "file_bytes.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <string>

#include "kiln/core/error.h"

namespace kiln::io {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const fs::path& path, const std::string& reason) {
  throw Error(Fault::Input, fmt::format("{}: {}", path.string(), reason));
}

uintmax_t size_of_readable(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (status.type() == fs::file_type::not_found) refuse(path, "no such file");
  if (error) refuse(path, error.message());
  if (fs::is_directory(status)) refuse(path, "is a folder, expected an image file");
  if (!fs::is_regular_file(status)) refuse(path, "is not a regular file");
  const uintmax_t size = fs::file_size(path, error);
  if (error) refuse(path, error.message());
  if (size == 0) refuse(path, "the file is empty (0 bytes)");
  return size;
}

Bytes read_bytes(const fs::path& path, uintmax_t count) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"),
                                                             std::fclose);
  if (!file) refuse(path, std::strerror(errno));
  Bytes bytes(count);
  const size_t got = std::fread(bytes.data(), 1, bytes.size(), file.get());
  if (std::ferror(file.get()) != 0) refuse(path, "reading fails");
  bytes.resize(got);
  return bytes;
}

void* mapped(const fs::path& path, size_t size) {
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) refuse(path, std::strerror(errno));
  void* at = mmap(nullptr, size, PROT_READ, MAP_PRIVATE, file, 0);
  const int reason = errno;
  close(file);
  if (at == MAP_FAILED) refuse(path, std::strerror(reason));
  return at;
}

}  // namespace

Bytes first_bytes(const fs::path& path, size_t count) {
  return read_bytes(path, std::min<uintmax_t>(count, size_of_readable(path)));
}

Bytes all_bytes(const fs::path& path) { return read_bytes(path, size_of_readable(path)); }

FileContents::FileContents(const fs::path& path) {
  const auto size = static_cast<size_t>(size_of_readable(path));
  if (size <= largest_held) {
    held_ = read_bytes(path, size);
    view_ = held_;
  } else {
    mapped_ = mapped(path, size);
    view_ = {static_cast<const uint8_t*>(mapped_), size};
  }
}

FileContents::~FileContents() {
  if (mapped_ != nullptr) munmap(mapped_, view_.size());
}

void FileContents::let_go() const noexcept {
  if (mapped_ != nullptr) madvise(mapped_, view_.size(), MADV_DONTNEED);
}

}  // namespace kiln::io
