// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <vector>

namespace kiln {

/// Runs row(i) for i in [0, count) on all threads. Rows may run in any order and must not share
/// what they write; an exception from any row is rethrown here.
void for_rows(int count, const std::function<void(int)>& row);

/// Sum over rows of a vector of doubles: each row adds its share into its own vector of length
/// `width`, and rows are added in order, so the bits do not depend on the threads.
std::vector<double> sum_rows(int count, int width,
                             const std::function<void(int, std::vector<double>&)>& row);

}  // namespace kiln
