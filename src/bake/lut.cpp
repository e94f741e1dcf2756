// SPDX-License-Identifier: Apache-2.0
#include "kiln/bake/lut.h"

#include <fmt/format.h>

#include "bakes.h"
#include "kiln/brdf/models.h"
#include "kiln/table/lut.h"

namespace kiln {
namespace {

using Settings = LutBake::Settings;

// A word out of a list of names, kept as text.
Param<Settings> named_param(std::string name, std::string Settings::*member,
                            std::vector<std::string> choices, std::string meaning) {
  ParamFacts facts{
      std::move(name),   ParamFacts::Kind::Word, Settings{}.*member, 0, 0, std::move(choices), "",
      std::move(meaning)};
  return {facts, [facts, member](Settings& settings, const std::string& text) {
            settings.*member = facts.choices[parse_word(facts, text)];
          }};
}

std::vector<std::string> describe_channels(const TableFacts& table) {
  std::vector<std::string> described;
  for (const TableChannel& channel : table.channels) described.push_back(channel.meaning);
  return described;
}

std::vector<std::pair<std::string, std::string>> describe_file(const Settings& settings,
                                                               const TableFacts& table,
                                                               const Lut& lut) {
  std::vector<std::pair<std::string, std::string>> attributes = {
      {"kiln:table", table.name},
      {"kiln:models", fmt::format("distribution={} masking={} fresnel={}", settings.distribution,
                                  settings.masking, settings.fresnel)},
      {"kiln:axes", "x=mu (n.v), y=roughness (perceptual, alpha = roughness^2)"},
      {"kiln:alignment", "center: (i + 0.5) / N"},
      {"kiln:origin", "top: the first row is the smoothest"},
      {"kiln:entry_error", fmt::format("{:.3g}", lut.entry_error)},
      {"kiln:lookup_error",
       fmt::format("{:.3g} for mu in [0.001,1], roughness in [0,1]; {:.3g} for mu in [0.05,1], "
                   "roughness in [0.1,1]; bilinear, clamped",
                   lut.lookup_error, lut.lookup_error_inner)},
  };
  for (const TableChannel& channel : table.channels) {
    attributes.emplace_back("kiln:channel_" + channel.name, channel.meaning);
  }
  return attributes;
}

}  // namespace

Params<Settings> LutBake::params() {
  return {
      named_param("table", &Settings::table, table_names(), "what is integrated"),
      extent_param("size", &Settings::size, {2, 4096}, "entries along n.v and roughness"),
      named_param("distribution", &Settings::distribution, model_names("distribution"),
                  "microfacet normals"),
      named_param("masking", &Settings::masking, model_names("masking"), "masking and shadowing"),
      named_param("fresnel", &Settings::fresnel, model_names("fresnel"), "Fresnel reflectance"),
  };
}

Baked LutBake::bake(const Settings& settings, const Ingredients&) {
  const TableFacts& table = find_table(settings.table);
  Lut lut = build_lut(table, settings.size);
  Baked baked;
  baked.figures = {{"entry error", lut.entry_error},
                   {"lookup error", lut.lookup_error},
                   {"lookup error, mu >= 0.05 and roughness >= 0.1", lut.lookup_error_inner}};
  auto attributes = describe_file(settings, table, lut);
  baked.artifacts.push_back({"", "", std::move(lut.image), "", std::move(attributes)});
  return baked;
}

std::vector<double> integrate_at(const std::string& table, double mu, double roughness) {
  const TableFacts& facts = find_table(table);
  if (!(mu >= 1e-4 && mu <= 1) || !(roughness >= 0 && roughness <= 1)) {
    throw Error(
        Fault::Usage,
        fmt::format("found mu {} and roughness {}, expected mu in [0.0001, 1] and roughness "
                    "in [0, 1]",
                    mu, roughness));
  }
  return integrate_at(facts, mu, roughness);
}

std::vector<TableSummary> list_tables() {
  std::vector<TableSummary> tables;
  for (const TableFacts& facts : all_tables()) {
    tables.push_back({facts.name, facts.summary, describe_channels(facts)});
  }
  return tables;
}

std::vector<std::string> table_channels(const std::string& table) {
  return describe_channels(find_table(table));
}

}  // namespace kiln
