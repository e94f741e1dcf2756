// SPDX-License-Identifier: Apache-2.0
#include "kiln/light/chain_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>

#include "kiln/core/error.h"
#include "kiln/core/find_named.h"

namespace kiln {
namespace {

// Halvings from `size` down to no less than `smallest`, and one.
int levels_down_to(int size, int smallest) {
  int levels = 1;
  while (size / 2 >= smallest) {
    size /= 2;
    ++levels;
  }
  return levels;
}
int down_to_16(int size) { return levels_down_to(size, 16); }
int down_to_1(int size) { return levels_down_to(size, 1); }
int at_most_7(int size) { return std::min(7, down_to_1(size)); }
int at_most_6(int size) { return std::min(6, down_to_1(size)); }

double along(int level, int levels) {
  return levels > 1 ? static_cast<double>(level) / (levels - 1) : 0.0;
}

double linear(int level, int levels, int) { return along(level, levels); }
double filament(int level, int levels, int) { return 1 - std::sqrt(1 - along(level, levels)); }

// t = r (1.7 - 0.7 r) with t in sixths whatever the count of levels.
double unity(int level, int, int) {
  const double t = std::min(1.0, level / 6.0);
  return std::min(1.0, (1.7 - std::sqrt(1.7 * 1.7 - 2.8 * t)) / 1.4);
}

double babylon(int level, int, int size) {
  return level == 0 ? 0.0 : std::sqrt(std::min(1.0, std::exp2(level / 0.8) / size));
}

double materialx(int level, int levels, int) {
  const double t = along(level, levels);
  return t < 0.5 ? t : std::sqrt(std::min(1.0, 2 * (t - 0.375)));
}

// Exponents 2048, 512, 128, 32, 8, 2 of gloss = log2(exponent) / 11.
double playcanvas(int level, int, int) { return std::min(1.0, 2 * level / 11.0); }

std::vector<double> listed_roughness(const std::string& text) {
  std::vector<double> values;
  for (size_t begin = 0; begin <= text.size();) {
    const size_t end = std::min(text.find(',', begin), text.size());
    double value = 0;
    const char *first = text.data() + begin, *last = text.data() + end;
    const auto [stopped, failure] = std::from_chars(first, last, value);
    if (failure != std::errc() || stopped != last || !(value >= 0 && value <= 1)) {
      throw Error(Fault::Usage, fmt::format("curve: found '{}', expected roughnesses in [0,1] "
                                            "separated by commas",
                                            text.substr(begin, end - begin)));
    }
    values.push_back(value);
    begin = end + 1;
  }
  return values;
}

const RoughnessCurve& find_curve(const std::string& name) {
  return find_named(all_roughness_curves(), "curve", name);
}

bool is_list(const std::string& text) {
  return !text.empty() && (std::isdigit(static_cast<unsigned char>(text[0])) || text[0] == '.');
}

}  // namespace

const std::vector<RoughnessCurve>& all_roughness_curves() {
  static const std::vector<RoughnessCurve> curves{
      {"filament", "1 - sqrt(1 - t), levels of 16 and more; also three.js", "Filament cmgen",
       down_to_16, filament},
      {"linear", "t, levels of 16 and more", "Khronos glTF-IBL-Sampler", down_to_16, linear},
      {"unity", "r with r (1.7 - 0.7 r) = level / 6, at most 7 levels",
       "Unity image based lighting", at_most_7, unity},
      {"babylon", "sqrt(min(1, 2^(level / 0.8) / size)), levels down to 1",
       "Babylon.js, lodGenerationScale 0.8", down_to_1, babylon},
      {"materialx", "t below 1/2, then sqrt(2 t - 0.75), at most 1, levels down to 1",
       "MaterialX environment prefiltering", down_to_1, materialx},
      {"playcanvas", "2 level / 11, at most 6 levels", "PlayCanvas prefiltered cube maps",
       at_most_6, playcanvas},
  };
  return curves;
}

ChainPlan plan_chain(const std::string& curve, int size) {
  ChainPlan plan;
  if (is_list(curve)) {
    plan.roughness = listed_roughness(curve);
    const int most = down_to_1(size);
    if (static_cast<int>(plan.roughness.size()) > most) {
      throw Error(Fault::Usage, fmt::format("curve: found {} roughnesses, a chain of {} has at "
                                            "most {} levels",
                                            plan.roughness.size(), size, most));
    }
  } else {
    const RoughnessCurve& named = find_curve(curve);
    const int levels = named.levels(size);
    for (int level = 0; level < levels; ++level) {
      plan.roughness.push_back(named.roughness(level, levels, size));
    }
  }
  for (size_t level = 0; level < plan.roughness.size(); ++level) {
    plan.sizes.push_back(std::max(1, size >> level));
  }
  return plan;
}

}  // namespace kiln
