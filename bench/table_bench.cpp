// SPDX-License-Identifier: Apache-2.0
#include <benchmark/benchmark.h>

#include "kiln/table/albedo_table.h"
#include "kiln/table/lut.h"

namespace kiln {
namespace {

// The entries of an N x N table, on all threads: entries/s.
void table_entries(benchmark::State& state, const char* name) {
  const int n = static_cast<int>(state.range(0));
  const TableFacts& table = find_table(name);
  for (auto _ : state) benchmark::DoNotOptimize(integrate_entries(table, {n, n}));
  state.SetItemsProcessed(state.iterations() * n * n);
}
BENCHMARK_CAPTURE(table_entries, split_sum, "split-sum")
    ->Arg(128)
    ->Arg(256)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

// The same with both errors found.
void table_with_errors(benchmark::State& state) {
  const int n = static_cast<int>(state.range(0));
  for (auto _ : state) benchmark::DoNotOptimize(build_lut(find_table("split-sum"), {n, n}));
  state.SetItemsProcessed(state.iterations() * n * n);
}
BENCHMARK(table_with_errors)->Arg(128)->UseRealTime()->Unit(benchmark::kMillisecond);

void albedo_table(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(AlbedoTable::build());
}
BENCHMARK(albedo_table)->UseRealTime()->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace kiln
