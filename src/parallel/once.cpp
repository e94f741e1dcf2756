// SPDX-License-Identifier: Apache-2.0
#include "kiln/parallel/once.h"

#include <tbb/task_arena.h>

namespace kiln {

void Once::ensure(const std::function<void()>& work) {
  std::call_once(done_, [&] { tbb::this_task_arena::isolate([&] { work(); }); });
}

}  // namespace kiln
