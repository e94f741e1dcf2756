// SPDX-License-Identifier: Apache-2.0
#include "kiln/table/axis.h"

#include <algorithm>
#include <cmath>

#include "kiln/core/error.h"
#include "kiln/core/names.h"
#include "kiln/math/wide.h"

namespace kiln {
namespace {

double same(double x) { return x; }
double squared(double x) { return x * x; }
double root(double x) { return std::sqrt(x); }
double cubed(double x) { return x * x * x; }
double cube_root(double x) { return std::cbrt(x); }
double fourth_power(double x) { return squared(squared(x)); }
double fourth_root(double x) { return std::sqrt(std::sqrt(x)); }
double complement(double x) { return 1 - x; }

// Where the last entry of an axis lies whose end is infinite.
constexpr double last_position = 0.99;

double ior_value(double u) {
  const double z = squared(std::min(u, last_position));
  return (1 + z) / (1 - z);
}

double ior_position(double ior) { return std::sqrt((ior - 1) / (ior + 1)); }

// THE list of axes.
std::vector<AxisMapping> make_list() {
  using enum Quantity;
  return {
      {"mu", {"n.v", "ndotv", "cos"}, Mu, "u = n.v", "mu", same, same},
      {"sqrt-mu", {"sqrt(mu)", "mu=u^2"}, Mu, "u = sqrt(n.v)", "sqrt(mu)", squared, root},
      {"cbrt-mu",
       {"cbrt(mu)", "mu=u^3"},
       Mu,
       "u = cbrt(n.v)",
       "pow(mu, 1.0 / 3.0)",
       cubed,
       cube_root},
      {"sqrt-one-minus-mu",
       {"sqrt(1-mu)"},
       Mu,
       "u = sqrt(1 - n.v)",
       "sqrt(1.0 - mu)",
       [](double u) { return 1 - u * u; },
       [](double mu) { return std::sqrt(1 - mu); }},
      {"one-minus-sqrt-one-minus-mu",
       {"1-sqrt(1-mu)"},
       Mu,
       "u = 1 - sqrt(1 - n.v)",
       "1.0 - sqrt(1.0 - mu)",
       [](double u) { return 1 - squared(1 - u); },
       [](double mu) { return 1 - std::sqrt(1 - mu); }},
      {"roughness",
       {"sqrt-alpha", "sqrt(alpha)"},
       Roughness,
       "u = perceptual roughness = sqrt(alpha)",
       "roughness",
       same,
       same},
      {"alpha", {}, Roughness, "u = alpha = roughness^2", "roughness * roughness", root, squared},
      {"gloss",
       {"smoothness"},
       Roughness,
       "u = 1 - roughness",
       "1.0 - roughness",
       complement,
       complement},
      {"f0", {}, F0, "u = F0", "f0", same, same},
      {"sqrt-f0", {"sqrt(f0)"}, F0, "u = sqrt(F0)", "sqrt(f0)", squared, root},
      {"fourth-root-f0",
       {},
       F0,
       "u = F0^(1/4); the last entry holds u = 0.99",
       "sqrt(sqrt(f0))",
       [](double u) { return fourth_power(std::min(u, last_position)); },
       fourth_root},
      {"ior",
       {},
       Ior,
       "u = sqrt((ior - 1) / (ior + 1)), so F0 = u^4; the last entry holds u = 0.99",
       "sqrt((ior - 1.0) / (ior + 1.0))",
       ior_value,
       ior_position},
      {"anisotropy", {}, Anisotropy, "u = anisotropy", "anisotropy", same, same},
      {"cosine",
       {"n.l"},
       Cosine,
       "u = n.l / 2 + 1/2",
       "cosine * 0.5 + 0.5",
       [](double u) { return 2 * u - 1; },
       [](double cosine) { return 0.5 * cosine + 0.5; }},
      {"schlick-exponent",
       {},
       Exponent,
       "u = 5 / (5 + exponent of 1 - c); the last entry holds u = 0.99",
       "5.0 / (5.0 + exponent)",
       [](double u) {
         const double z = std::clamp(u, 1e-4, last_position);
         return 5 * (1 - z) / z;
       },
       [](double exponent) { return 5 / (5 + exponent); }},
      {"curvature", {}, Curvature, "u = curvature [1/mm]", "curvature", same, same},
  };
}

bool answers_to(const AxisMapping& mapping, const std::string& name) {
  return mapping.name == name ||
         std::count(mapping.aliases.begin(), mapping.aliases.end(), name) > 0;
}

}  // namespace

const std::vector<AxisMapping>& all_axis_mappings() {
  static const std::vector<AxisMapping> mappings = make_list();
  return mappings;
}

const AxisMapping& find_axis_mapping(const std::string& name) {
  std::vector<std::string> known;
  for (const AxisMapping& mapping : all_axis_mappings()) {
    if (answers_to(mapping, kebab(name))) return mapping;
    known.push_back(mapping.name);
  }
  throw Error(Fault::Usage, unknown_name("axis", name, known));
}

double entry_position(int i, int count, Alignment alignment) {
  if (alignment == Alignment::Center) return (i + 0.5) / count;
  return count > 1 ? static_cast<double>(i) / (count - 1) : 0.5;
}

std::string quantity_name(Quantity quantity) {
  constexpr const char* names[] = {"mu",         "roughness", "f0",        "ior",
                                   "anisotropy", "cosine",    "curvature", "exponent"};
  return names[static_cast<int>(quantity)];
}

}  // namespace kiln
