// SPDX-License-Identifier: Apache-2.0
#include "kiln/store/byte_stream.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include "kiln/core/error.h"

namespace kiln {
namespace {

constexpr size_t block_bytes = 1 << 16;

}  // namespace

ByteStream::ByteStream(const std::filesystem::path& path, std::filesystem::path shown_path)
    : shown_path_(std::move(shown_path)),
      descriptor_(open(path.c_str(), O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, 0666)) {
  if (descriptor_ < 0) reason_ = errno;
}

ByteStream::~ByteStream() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void ByteStream::append(std::string_view bytes) {
  const bool follows = position_ == pending_at_ + pending_.size();
  if (!follows || pending_.size() + bytes.size() > block_bytes) flush();
  if (bytes.size() > block_bytes) {
    write_at(position_, bytes);
  } else {
    if (pending_.empty()) pending_at_ = position_;
    pending_ += bytes;
  }
  position_ += bytes.size();
}

void ByteStream::insert(uint64_t place, std::string_view bytes) {
  flush();
  move_back(place, position_, bytes.size());
  write_at(place, bytes);
  position_ += bytes.size();
}

void ByteStream::check() const {
  if (reason_ == 0) return;
  throw Error(Fault::Output,
              fmt::format("{}: cannot write: {}", shown_path_.string(), std::strerror(reason_)));
}

void ByteStream::close() {
  flush();
  const int descriptor = std::exchange(descriptor_, -1);
  if (descriptor >= 0 && ::close(descriptor) != 0 && reason_ == 0) reason_ = errno;
  check();
}

void ByteStream::flush() {
  write_at(pending_at_, pending_);
  pending_.clear();
}

void ByteStream::write_at(uint64_t place, std::string_view bytes) {
  while (reason_ == 0 && !bytes.empty()) {
    const ssize_t written =
        pwrite(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(place));
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) {
      reason_ = errno;
      return;
    }
    place += static_cast<uint64_t>(written);
    bytes.remove_prefix(static_cast<size_t>(written));
  }
}

// From the end, so that nothing is overwritten before it has moved.
void ByteStream::move_back(uint64_t first, uint64_t end, uint64_t distance) {
  std::string block;
  while (end > first) {
    block.resize(std::min<uint64_t>(block_bytes, end - first));
    end -= block.size();
    if (!read_at(end, block)) return;
    write_at(end + distance, block);
  }
}

bool ByteStream::read_at(uint64_t place, std::string& bytes) {
  for (size_t done = 0; reason_ == 0 && done < bytes.size();) {
    const ssize_t count = pread(descriptor_, bytes.data() + done, bytes.size() - done,
                                static_cast<off_t>(place + done));
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) {
      reason_ = count < 0 ? errno : EIO;
    } else {
      done += static_cast<size_t>(count);
    }
  }
  return reason_ == 0;
}

}  // namespace kiln
