// SPDX-License-Identifier: Apache-2.0
// bench_environment SOURCE SIZE [FOLDER]: milliseconds that a chain takes to compute, and its
// errors against brute force; with a FOLDER of cmgen's faces (mN_px.exr), theirs too.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>

#include "kiln/io/image_file.h"
#include "kiln/light/chain_plan.h"
#include "kiln/light/filter_error.h"
#include "kiln/light/irradiance.h"

namespace kiln {
namespace {

namespace fs = std::filesystem;

std::vector<FilterLobe> lobes_of(const ChainPlan& plan) {
  std::vector<FilterLobe> lobes;
  for (size_t level = 1; level < plan.sizes.size(); ++level) {
    lobes.push_back({.alpha = square(plan.roughness[level])});
  }
  return lobes;
}

struct Chain {
  std::vector<Layers> first;
  std::vector<FilteredLevel> levels;
};

Chain compute(const Layers& source, const ChainPlan& plan) {
  const std::vector<FilterLobe> lobes = lobes_of(plan);
  Chain chain{average_over_texels(source, {.size = plan.sizes[0]}), {}};
  const Prefilter prefilter(source, lobes);
  for (size_t i = 0; i < lobes.size(); ++i) {
    const SphereGrid grid{.size = plan.sizes[i + 1]};
    chain.levels.push_back({lobes[i], grid, prefilter.filter(lobes[i], grid)});
  }
  return chain;
}

std::vector<FilteredLevel> read_theirs(const fs::path& folder, const ChainPlan& plan) {
  std::vector<FilteredLevel> levels;
  const std::vector<FilterLobe> lobes = lobes_of(plan);
  for (size_t i = 0; i < lobes.size(); ++i) {
    levels.push_back({lobes[i], {.size = plan.sizes[i + 1]}, {}});
    for (const auto face : cube_face_names) {
      levels.back().images.push_back(
          read_image(folder / fmt::format("m{}_{}.exr", i + 1, face)).image);
    }
  }
  return levels;
}

void print_errors(const char* whose, const Prefilter& prefilter,
                  const std::vector<FilteredLevel>& levels, double mean) {
  for (const FilterError& error : filter_errors(prefilter, levels, mean)) {
    fmt::print("{}: rms error {:.2g}, greatest {:.2g} of the mean radiance\n", whose, error.rms,
               error.max);
  }
}

void run(const fs::path& image, int size, const fs::path& theirs) {
  const Layers source = read_image(image).image;
  const ChainPlan plan = plan_chain("filament", size);
  std::vector<double> times_ms;
  Chain chain;
  for (int i = 0; i < 7; ++i) {
    const auto start = std::chrono::steady_clock::now();
    chain = compute(source, plan);
    const std::chrono::duration<double, std::milli> taken =
        std::chrono::steady_clock::now() - start;
    times_ms.push_back(taken.count());
  }
  std::sort(times_ms.begin(), times_ms.end());
  fmt::print("computing {:.1f}\n", times_ms[times_ms.size() / 2]);
  const Prefilter prefilter(source, lobes_of(plan));
  const double mean = luminance(mean_radiance(source));
  print_errors("kiln ", prefilter, chain.levels, mean);
  if (!theirs.empty()) print_errors("cmgen", prefilter, read_theirs(theirs, plan), mean);
}

}  // namespace
}  // namespace kiln

int main(int count, char** arguments) {
  if (count < 3) {
    fmt::print(stderr, "usage: bench_environment SOURCE SIZE [FOLDER]\n");
    return 2;
  }
  kiln::run(arguments[1], std::stoi(arguments[2]), count > 3 ? arguments[3] : "");
  return 0;
}
