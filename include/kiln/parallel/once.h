// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <mutex>

namespace kiln {

/// Work that is done when it is first asked for, by one thread, while all others that ask wait.
class Once {
 public:
  /// Does the work, unless it was done. Rows that it runs on all threads are not mixed with other
  /// work, which might ask for the same. An exception is rethrown here, and the work left undone.
  void ensure(const std::function<void()>& work);

 private:
  std::once_flag done_;
};

}  // namespace kiln
