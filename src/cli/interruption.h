// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <thread>

namespace kiln {

/// Turns SIGINT and SIGTERM into a question that a run asks between tasks, and between bands of
/// large files. A second signal ends the process at once. Made before any other thread, which
/// inherit that these signals are blocked.
class Interruption {
 public:
  Interruption();
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;

  /// The signal that came first, or 0.
  int signal() const { return signal_; }

 private:
  std::atomic<int> signal_{0};
  std::jthread listener_;
};

}  // namespace kiln
