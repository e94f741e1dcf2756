// SPDX-License-Identifier: Apache-2.0
#include "kinds.h"

#include <algorithm>

#include "kiln/brdf/roughness.h"
#include "kiln/parallel/rows.h"
#include "kiln/table/glass_albedo.h"
#include "kiln/table/lut.h"
#include "kiln/table/view_rule.h"

namespace kiln::validate {
namespace {

std::vector<const AxisMapping*> mappings(const std::vector<std::string>& names) {
  std::vector<const AxisMapping*> found;
  found.reserve(names.size());
  for (const std::string& name : names) found.push_back(&find_axis_mapping(name));
  return found;
}

std::vector<Content> contents(const std::vector<std::string>& names) {
  std::vector<Content> found;
  found.reserve(names.size());
  for (const std::string& name : names) {
    const ChannelFacts& channel = find_channel(name);
    found.push_back({channel.meaning, channel.fill});
  }
  return found;
}

// Every diffuse model on the list that is not the same from everywhere.
std::vector<Content> diffuse_contents() {
  std::vector<Content> found = contents({"unity-disney"});
  for (const ChannelFacts& channel : all_channels()) {
    if (!channel.name.starts_with("diffuse-") || channel.name == "diffuse-lambert") continue;
    found.push_back({channel.meaning, channel.fill});
  }
  return found;
}

// Light that leaves, what refraction turns back to the side it came from among it: samplers that do
// not look at the side count it.
std::vector<double> fill_leaving_unsorted(TableContext& context) {
  const auto& mus = context.grid.of(Quantity::Mu);
  const auto& roughnesses = context.grid.of(Quantity::Roughness);
  const auto& iors = context.grid.of(Quantity::Ior);
  const size_t rows = roughnesses.size() * iors.size();
  std::vector<double> values(rows * mus.size());
  for_rows(static_cast<int>(rows), [&](int row) {
    const double alpha = to_alpha(roughnesses[row % roughnesses.size()]);
    const double ior = std::max(iors[row / roughnesses.size()], 1 + 1e-6);
    for (size_t i = 0; i < mus.size(); ++i) {
      const GlassTerms terms = integrate_glass(mus[i], alpha, 1 / ior);
      values[row * mus.size() + i] = terms.total() + terms.strayed;
    }
  });
  return values;
}

Kind glass() {
  Kind kind{"glass",
            {mappings({"mu"}), mappings({"roughness", "alpha"}), mappings({"ior"})},
            contents({"enter-total", "leave-total", "enter-reflected", "enter-transmitted",
                      "leave-reflected", "leave-transmitted"}),
            1.0};
  kind.contents.push_back(
      {"leaving: reflected, let through and turned back by refraction", fill_leaving_unsorted});
  return kind;
}

// The mappings of a quantity that are tried, that of the table first.
std::vector<const AxisMapping*> mappings_like(const std::string& own) {
  const AxisMapping& first = find_axis_mapping(own);
  std::vector<const AxisMapping*> found{&first};
  const auto add = [&](const std::vector<std::string>& others) {
    for (const std::string& name : others) {
      if (name != first.name) found.push_back(&find_axis_mapping(name));
    }
  };
  if (first.quantity == Quantity::Mu) add({"mu", "sqrt-mu"});
  if (first.quantity == Quantity::Roughness) add({"roughness", "alpha"});
  if (first.quantity == Quantity::F0) add({"fourth-root-f0", "sqrt-f0", "f0"});
  return found;
}

// A table of three axes on the list of tables.
Kind solid(const TableFacts& table) {
  Kind kind{table.name, {}, contents(table.channels)};
  for (const std::string& axis : table.axes) kind.axes.push_back(mappings_like(axis));
  return kind;
}

// Their names are those of the tables that kiln bakes.
std::vector<Kind> make_kinds() {
  std::vector<Kind> kinds{
      {"diffuse",
       {mappings({"mu", "sqrt-mu", "cbrt-mu", "sqrt-one-minus-mu", "one-minus-sqrt-one-minus-mu"}),
        mappings({"roughness", "alpha"})},
       diffuse_contents()},
      {"skin",
       {mappings({"cosine"}), mappings({"curvature"})},
       contents({"skin-red", "skin-green", "skin-blue"})}};
  for (const TableFacts& table : all_tables()) {
    if (table.axes.size() == 3 && table.name != "glass") kinds.push_back(solid(table));
  }
  kinds.push_back(glass());  // what it reflects is the table `ior` too, which is named first
  return kinds;
}

}  // namespace

const std::vector<Kind>& all_kinds() {
  static const std::vector<Kind> kinds = make_kinds();
  return kinds;
}

std::vector<std::vector<double>> fill_contents(const Kind& kind, const Coordinates& coordinates,
                                               const std::vector<int>& wanted) {
  TableGrid grid;
  for (size_t q = 0; q < kind.axes.size(); ++q) {
    grid.of(kind.axes[q][0]->quantity) = coordinates[q];
  }
  for (double& mu : grid.of(Quantity::Mu)) mu = std::max(mu, least_mu);
  LobeCache lobes(Quality::Table, least_mu);
  const TableModels models;
  TableContext context{models, grid, grid, lobes};
  std::vector<std::vector<double>> values;
  values.reserve(wanted.size());
  for (const int content : wanted) values.push_back(kind.contents[content].fill(context));
  return values;
}

}  // namespace kiln::validate
