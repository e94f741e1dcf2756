// SPDX-License-Identifier: Apache-2.0
#include "kiln/parallel/threads.h"

#include <sched.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <string>

namespace kiln {
namespace {

int allowed_processors() {
  cpu_set_t set;
  CPU_ZERO(&set);
  if (sched_getaffinity(0, sizeof set, &set) != 0) return 1;
  return std::max(1, CPU_COUNT(&set));
}

// Quota of control group v2 ("max 100000" or "200000 100000"), else of v1; 0 where there is none.
double control_group_quota() {
  double quota = 0, period = 0;
  if (std::ifstream file("/sys/fs/cgroup/cpu.max"); file >> quota >> period && period > 0) {
    return quota / period;
  }
  std::ifstream quota_file("/sys/fs/cgroup/cpu/cpu.cfs_quota_us");
  std::ifstream period_file("/sys/fs/cgroup/cpu/cpu.cfs_period_us");
  if (quota_file >> quota && period_file >> period && quota > 0 && period > 0)
    return quota / period;
  return 0;
}

}  // namespace

int available_threads() {
  const int processors = allowed_processors();
  const double quota = control_group_quota();
  if (quota <= 0) return processors;
  return std::clamp(static_cast<int>(std::ceil(quota)), 1, processors);
}

struct ThreadLimit::Control {
  tbb::global_control parallelism;
};

ThreadLimit::ThreadLimit(int threads)
    : control_(std::make_unique<Control>(Control{{tbb::global_control::max_allowed_parallelism,
                                                  static_cast<size_t>(std::max(1, threads))}})) {}

ThreadLimit::~ThreadLimit() = default;

}  // namespace kiln
