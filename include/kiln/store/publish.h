// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "kiln/store/byte_stream.h"

namespace kiln {

/// Makes a file appear whole or not at all: `write` fills a uniquely named, hidden temporary file
/// in the folder of `path`; it is flushed to disk and renamed. If `write` throws, nothing is left
/// behind and a file that was already there is untouched. Missing folders are created. The
/// temporary keeps the extension of `path`, since writers choose their format by it.
///
/// Safe to call from many threads and many processes, also for one and the same `path`: the last
/// rename wins, and every reader sees one whole file.
///
/// @param write  must create the file that it is given, and close it
/// @error Fault::Output when the folder or the file cannot be written; what `write` throws
void publish_file(const std::filesystem::path& path,
                  const std::function<void(const std::filesystem::path& temporary)>& write);

/// Publishes what `write` puts into the stream, which need not be held as a whole.
/// @error Fault::Output with path and reason; what `write` throws
void publish_stream(const std::filesystem::path& path,
                    const std::function<void(ByteStream& out)>& write);

/// The same for a file that grows while others do: it appears when it is put in place, and never if
/// that does not come to pass.
class Publication {
 public:
  /// @error Fault::Output when the folder or the file cannot be made
  explicit Publication(const std::filesystem::path& path);
  ~Publication();
  Publication(const Publication&) = delete;
  Publication& operator=(const Publication&) = delete;

  ByteStream& stream();
  /// Nothing may be written afterwards. @error Fault::Output with path and reason
  void put_in_place();

 private:
  struct Unfinished;
  std::unique_ptr<Unfinished> unfinished_;
};

/// Publishes these bytes as they are; text needs no other treatment.
/// @error Fault::Output with path and reason
void publish_text(const std::filesystem::path& path, const std::string& text);

/// Checks that files can be made in `folder` (which is created) by making one and removing it.
/// @error Fault::Output with the reason
void require_writable_folder(const std::filesystem::path& folder);

}  // namespace kiln
