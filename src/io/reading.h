// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

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

}  // namespace kiln::io
