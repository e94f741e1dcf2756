// SPDX-License-Identifier: Apache-2.0
#include "kiln/store/publish.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <random>
#include <string_view>
#include <system_error>
#include <utility>

#include "kiln/core/error.h"

namespace kiln {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const fs::path& path, std::string_view doing, int reason) {
  throw Error(Fault::Output,
              fmt::format("{}: cannot {}: {}", path.string(), doing, std::strerror(reason)));
}

// Processes of one machine differ by their id, and those of other machines on a shared disk by a
// token drawn once; threads of a process differ by the counter.
std::string unique_suffix() {
  static const uint32_t token = std::random_device{}();
  static std::atomic<uint64_t> counter{0};
  return fmt::format("{}-{:08x}-{}", getpid(), token, counter.fetch_add(1));
}

fs::path temporary_beside(const fs::path& path) {
  constexpr size_t longest_stem = 150;  // file systems bound a name by 255 bytes
  const std::string stem = path.stem().string().substr(0, longest_stem);
  return path.parent_path() /
         fmt::format(".{}.{}.partial{}", stem, unique_suffix(), path.extension().string());
}

void make_folder(const fs::path& folder) {
  if (folder.empty()) return;
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) refuse(folder, "make the folder", error.value());
}

// Removes the temporary unless it was renamed away.
class Temporary {
 public:
  explicit Temporary(fs::path path) : path_(std::move(path)) {}
  ~Temporary() {
    std::error_code ignored;
    if (!renamed_) fs::remove(path_, ignored);
  }
  Temporary(const Temporary&) = delete;
  Temporary& operator=(const Temporary&) = delete;

  const fs::path& path() const { return path_; }

  void rename_to(const fs::path& target) {
    if (std::rename(path_.c_str(), target.c_str()) != 0) refuse(target, "put in place", errno);
    renamed_ = true;
  }

 private:
  fs::path path_;
  bool renamed_ = false;
};

// File systems without fsync answer EINVAL; there is nothing more to ask of them.
void flush_to_disk(const fs::path& temporary, const fs::path& path) {
  const int file = open(temporary.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) refuse(path, "write", errno);
  const int reason = fsync(file) == 0 ? 0 : errno;
  ::close(file);
  if (reason != 0 && reason != EINVAL) refuse(path, "flush to disk", reason);
}

// The name of a temporary for that file, whose folder is made.
fs::path begin(const fs::path& path) {
  if (!path.has_filename()) refuse(path, "write a file without a name", EINVAL);
  make_folder(path.parent_path());
  return temporary_beside(path);
}

}  // namespace

void publish_file(const fs::path& path, const std::function<void(const fs::path&)>& write) {
  Temporary temporary(begin(path));
  write(temporary.path());
  flush_to_disk(temporary.path(), path);
  temporary.rename_to(path);
}

struct Publication::Unfinished {
  explicit Unfinished(fs::path path_in)
      : path(std::move(path_in)), temporary(begin(path)), out(temporary.path(), path) {
    out.check();
  }

  fs::path path;
  Temporary temporary;
  ByteStream out;
};

Publication::Publication(const fs::path& path) : unfinished_(std::make_unique<Unfinished>(path)) {}
Publication::~Publication() = default;

ByteStream& Publication::stream() { return unfinished_->out; }

void Publication::put_in_place() {
  unfinished_->out.close();
  flush_to_disk(unfinished_->temporary.path(), unfinished_->path);
  unfinished_->temporary.rename_to(unfinished_->path);
}

void publish_stream(const fs::path& path, const std::function<void(ByteStream&)>& write) {
  Publication publication(path);
  write(publication.stream());
  publication.put_in_place();
}

void publish_text(const fs::path& path, const std::string& text) {
  publish_stream(path, [&](ByteStream& out) { out.append(text); });
}

void require_writable_folder(const fs::path& folder) {
  make_folder(folder);
  const Temporary probe(temporary_beside(folder / "probe"));
  ByteStream(probe.path(), folder).close();
}

}  // namespace kiln
