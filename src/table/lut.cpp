// SPDX-License-Identifier: Apache-2.0
#include "kiln/table/lut.h"

#include <algorithm>
#include <cmath>

#include "kiln/brdf/roughness.h"
#include "kiln/core/error.h"
#include "kiln/core/names.h"
#include "kiln/parallel/rows.h"
#include "kiln/table/directional_albedo.h"

namespace kiln {
namespace {

using Terms = SplitSumTerms<double>;

std::vector<TableFacts> make_list() {
  return {
      {"split-sum",
       "F0 * scale + F90 * bias is the reflectance of the specular lobe",
       {{"R", "scale: multiplies F0"}, {"G", "bias: multiplies F90"}},
       [](const Terms& terms) {
         return std::vector{terms.scale, terms.bias};
       }},
      {"directional-albedo",
       "share of light that the specular lobe reflects with F = 1",
       {{"Y", "E: directional albedo"}},
       [](const Terms& terms) { return std::vector{terms.total()}; }},
  };
}

double texel_centre(int i, int n) { return (i + 0.5) / n; }

using Entries = std::vector<std::vector<double>>;
using OrderOf = QuadratureOrder (*)(double mu);

// Columns share the part of the rule that depends on the view alone.
Entries integrate_columns(const TableFacts& table, Size size, OrderOf order_of) {
  Entries entries(table.channels.size(), std::vector<double>(static_cast<size_t>(area(size))));
  for_rows(size.width, [&](int x) {
    const double mu = texel_centre(x, size.width);
    const QuadratureOrder order = order_of(mu);
    const ViewRule rule = make_view_rule(mu, order.azimuths);
    for (int y = 0; y < size.height; ++y) {
      const double alpha = to_alpha(texel_centre(y, size.height));
      const auto values = table.values(integrate_split_sum(rule, alpha, order.slopes));
      for (size_t c = 0; c < values.size(); ++c) {
        entries[c][static_cast<size_t>(y) * size.width + x] = values[c];
      }
    }
  });
  return entries;
}

double greatest_difference(const Entries& a, const Entries& b) {
  double greatest = 0;
  for (size_t c = 0; c < a.size(); ++c) {
    for (size_t i = 0; i < a[c].size(); ++i) {
      greatest = std::max(greatest, std::abs(a[c][i] - b[c][i]));
    }
  }
  return greatest;
}

// What a sampler with clamped addressing reads at (mu, roughness).
double look_up(const std::vector<double>& entries, Size size, double mu, double roughness) {
  const double x = std::clamp(mu * size.width - 0.5, 0.0, size.width - 1.0);
  const double y = std::clamp(roughness * size.height - 0.5, 0.0, size.height - 1.0);
  const int i = std::min(static_cast<int>(x), size.width - 2);
  const int j = std::min(static_cast<int>(y), size.height - 2);
  const double* e = &entries[static_cast<size_t>(j) * size.width + i];
  const double top = std::lerp(e[0], e[1], x - i);
  const double bottom = std::lerp(e[size.width], e[size.width + 1], x - i);
  return std::lerp(top, bottom, y - j);
}

struct LookupErrors {
  double all = 0, inner = 0;
};

// Probes crowd toward grazing angles, where lookups err most.
LookupErrors probe_lookups(const TableFacts& table, const Entries& entries, Size size) {
  constexpr int probes = 96;
  std::vector<LookupErrors> worst(probes);
  for_rows(probes, [&](int i) {
    const double mu = 1e-3 + (1 - 1e-3) * square(texel_centre(i, probes));
    const ViewRule rule = make_view_rule(mu, table_order(mu).azimuths);
    for (int j = 0; j < probes; ++j) {
      const double roughness = static_cast<double>(j) / (probes - 1);
      const auto truth =
          table.values(integrate_split_sum(rule, to_alpha(roughness), table_order(mu).slopes));
      for (size_t c = 0; c < truth.size(); ++c) {
        const double error = std::abs(look_up(entries[c], size, mu, roughness) - truth[c]);
        worst[i].all = std::max(worst[i].all, error);
        if (mu >= 0.05 && roughness >= 0.1) worst[i].inner = std::max(worst[i].inner, error);
      }
    }
  });
  LookupErrors result;
  for (const LookupErrors& one : worst) {
    result.all = std::max(result.all, one.all);
    result.inner = std::max(result.inner, one.inner);
  }
  return result;
}

}  // namespace

const std::vector<TableFacts>& all_tables() {
  static const std::vector<TableFacts> tables = make_list();
  return tables;
}

std::vector<std::string> table_names() {
  std::vector<std::string> names;
  for (const TableFacts& table : all_tables()) names.push_back(table.name);
  return names;
}

const TableFacts& find_table(const std::string& name) {
  for (const TableFacts& table : all_tables()) {
    if (table.name == kebab(name)) return table;
  }
  throw Error(Fault::Usage, unknown_name("table", name, table_names()));
}

std::vector<double> integrate_at(const TableFacts& table, double mu, double roughness) {
  return table.values(integrate_split_sum(mu, to_alpha(roughness), reference_order));
}

std::vector<std::vector<double>> integrate_entries(const TableFacts& table, Size size) {
  return integrate_columns(table, size, table_order);
}

Lut build_lut(const TableFacts& table, Size size) {
  const Entries entries = integrate_entries(table, size);
  const Entries finer = integrate_columns(table, size, [](double mu) {
    const QuadratureOrder order = table_order(mu);
    return QuadratureOrder{2 * order.azimuths, 2 * order.slopes};
  });
  const LookupErrors lookup = probe_lookups(table, entries, size);
  Lut lut{{size, {}}, greatest_difference(entries, finer), lookup.all, lookup.inner};
  for (size_t c = 0; c < entries.size(); ++c) {
    Plane& plane = lut.image.add(table.channels[c].name);
    for (int y = 0; y < size.height; ++y) {
      const double* row = &entries[c][static_cast<size_t>(y) * size.width];
      std::transform(row, row + size.width, plane.row(y),
                     [](double value) { return static_cast<float>(value); });
    }
  }
  return lut;
}

}  // namespace kiln
