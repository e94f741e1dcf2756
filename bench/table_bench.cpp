// SPDX-License-Identifier: Apache-2.0
#include <benchmark/benchmark.h>

#include "kiln/table/albedo_table.h"
#include "kiln/table/lut.h"

namespace kiln {
namespace {

TableRecipe recipe_for(const char* table, int n) {
  TableRecipe recipe = recipe_of(find_table(table));
  recipe.size = {n, n};
  complete(recipe);
  return recipe;
}

// An N x N table with both its errors, on all threads: entries/s.
void table(benchmark::State& state, const char* name) {
  const int n = static_cast<int>(state.range(0));
  const TableRecipe recipe = recipe_for(name, n);
  for (auto _ : state) benchmark::DoNotOptimize(build_lut(recipe));
  state.SetItemsProcessed(state.iterations() * n * n * recipe.depth);
}
BENCHMARK_CAPTURE(table, split_sum, "split-sum")
    ->RangeMultiplier(4)
    ->Range(64, 1024)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(table, ior, "ior")
    ->Arg(32)
    ->Arg(64)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(table, ltc, "ltc")->Arg(64)->UseRealTime()->Unit(benchmark::kMillisecond);

// Single integrals, one thread: entries/s at the order of tables.
void entry(benchmark::State& state, const char* distribution, const char* masking) {
  const LobeIntegrals lobe({distribution, masking, 0}, {}, Quality::Table);
  for (auto _ : state) benchmark::DoNotOptimize(lobe.at({0.3, 0.25, 0.25, 0}));
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK_CAPTURE(entry, ggx, "ggx", "smith-correlated")->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(entry, beckmann, "beckmann", "smith-correlated")->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(entry, phong_cavity, "phong", "v-cavity")->Unit(benchmark::kMicrosecond);

void albedo_table(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(AlbedoTable::build());
}
BENCHMARK(albedo_table)->UseRealTime()->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace kiln
