// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

namespace kiln {

/// Threads that this process may use: the CPU quota of its control group, at most the processors
/// it may run on, at least 1.
int available_threads();

/// Bounds the threads of the whole process for as long as it lives. Results never depend on it.
class ThreadLimit {
 public:
  explicit ThreadLimit(int threads);
  ~ThreadLimit();
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;

 private:
  struct Control;
  std::unique_ptr<Control> control_;
};

}  // namespace kiln
