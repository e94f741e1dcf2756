// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

#include "file_bytes.h"
#include "kiln/io/image_file.h"

namespace kiln::io {

/// How a file is to be read.
struct Reading {
  ReadLimits limits = {};
  std::vector<std::string> channels = {};  ///< names of those wanted; empty: all
  /// Called now and then: the bytes read so far may leave the memory (FileContents::let_go).
  std::function<void()> let_go = [] {};
  /// Runs tasks side by side; empty: one after another.
  RunTasks run = {};

  bool wants(const std::string& channel) const {
    return channels.empty() || std::count(channels.begin(), channels.end(), channel) > 0;
  }
};

/// The same, of a file's contents, which outlive it.
inline Reading in_pieces(Reading reading, const FileContents& contents) {
  reading.let_go = [&contents] { contents.let_go(); };
  return reading;
}

}  // namespace kiln::io
