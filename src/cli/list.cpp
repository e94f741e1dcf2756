// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>

#include "kiln/bake/bake.h"
#include "kiln/bake/environment.h"
#include "kiln/bake/lut.h"
#include "kiln/bake/pack_layout.h"
#include "kiln/brdf/models.h"
#include "kiln/color/color.h"
#include "kiln/core/error.h"
#include "kiln/material/naming.h"
#include "kiln/pipeline/pipeline.h"
#include "kiln/pipeline/schema.h"
#include "kiln/validate/model_measure.h"
#include "verb.h"

namespace kiln {
namespace {

using Json = nlohmann::ordered_json;

/// One thing that can be listed.
struct Item {
  std::string name;
  std::string summary;
  std::vector<std::pair<std::string, std::string>> facts = {};  ///< "source", "Walter et al. 2007"
  std::vector<Key> keys = {};                                   ///< parameters, where it has any
};

struct Kind {
  std::string name;
  std::string meaning;
  std::function<std::vector<Item>(const Globals&)> items;
  /// Adds what takes time to find out. Kinds that have this are listed with all their facts.
  std::function<void(Item&)> measure = {};
};

Key key_of(const ModelParam& param) {
  Key key;
  key.facts.name = std::string(param.name);
  key.facts.kind = ParamFacts::Kind::Number;
  key.facts.min = param.min;
  key.facts.max = param.max;
  key.facts.default_text = number_text(param.initial);
  key.facts.meaning = std::string(param.meaning);
  return key;
}

std::string range_text(const ParamFacts& facts) {
  if (!facts.choices.empty()) return fmt::format("{}", fmt::join(facts.choices, " | "));
  const bool numeric = facts.kind == ParamFacts::Kind::Integer ||
                       facts.kind == ParamFacts::Kind::Number ||
                       facts.kind == ParamFacts::Kind::Extent;
  if (!numeric || std::isinf(facts.min)) return "";
  return std::isinf(facts.max) ? fmt::format(">= {}", facts.min)
                               : fmt::format("{} .. {}", facts.min, facts.max);
}

std::string yes_or_no(bool value) { return value ? "yes" : "no"; }

std::vector<Item> list_models(const Globals&) {
  std::vector<Item> items;
  for (const ModelFacts& model : all_models()) {
    Item item{model.name, model.summary, {{"family", model.family}, {"source", model.source}}};
    if (model.reciprocal) item.facts.emplace_back("reciprocal", yes_or_no(*model.reciprocal));
    if (model.anisotropic) item.facts.emplace_back("anisotropic", yes_or_no(*model.anisotropic));
    if (model.exact_lambda) {
      const char* lambda = !*model.has_lambda ? "none" : *model.exact_lambda ? "exact" : "borrowed";
      item.facts.emplace_back("Smith's Lambda", lambda);
    }
    if (model.one_sided)
      item.facts.emplace_back("masking of one side", yes_or_no(*model.one_sided));
    for (const ModelParam& param : model.params) item.keys.push_back(key_of(param));
    items.push_back(std::move(item));
  }
  return items;
}

std::string energy_text(double greatest, double mu, double roughness) {
  const std::string verdict = greatest > 1.001 ? "; GAINS ENERGY" : "";
  return fmt::format("{:.4f} at n.v {:.3g}, roughness {:.2g}{}", greatest, mu, roughness, verdict);
}

std::string furnace_text(const LobeMeasure& measure) {
  if (!measure.weak_furnace) return "none: this masking has no one-sided form";
  const auto [least, greatest] = *measure.weak_furnace;
  const bool passes = least > 0.997 && greatest < 1.003;
  return fmt::format("{} ({:.4f} to {:.4f})", passes ? "passes" : "FAILS", least, greatest);
}

std::string reciprocal_text(const LobeMeasure& measure) {
  return fmt::format("{} (asymmetry {:.1g})", yes_or_no(measure.asymmetry < 1e-9),
                     measure.asymmetry);
}

// The partner that a model of one family is measured with.
Lobe measured_lobe(const std::string& family, const std::string& name) {
  const bool cloth = name == "charlie" || name == "estevez-kulla" || name.starts_with("neubelt");
  Lobe lobe;
  if (cloth) lobe = {"charlie", "neubelt", 0};
  if (family == "distribution") {
    lobe.distribution = name;
    const std::vector<std::string> fitting = fitting_maskings(name);
    if (std::find(fitting.begin(), fitting.end(), lobe.masking) == fitting.end()) {
      lobe.masking = fitting.front();
    }
  } else {
    lobe.masking = name;
  }
  return lobe;
}

void measure_model(Item& item) {
  const std::string family = item.facts.front().second;
  if (family == "diffuse") {
    const DiffuseMeasure measure = measure_diffuse(item.name);
    item.facts.emplace_back("greatest albedo, white",
                            energy_text(measure.greatest_albedo, measure.mu, measure.roughness));
  }
  if (family != "distribution" && family != "masking") return;
  const Lobe lobe = measured_lobe(family, item.name);
  const LobeMeasure measure = measure_lobe(lobe);
  const std::string partner = family == "masking" ? lobe.distribution : lobe.masking;
  item.facts.emplace_back("reciprocal", reciprocal_text(measure));
  item.facts.emplace_back("weak white furnace, with " + partner, furnace_text(measure));
  item.facts.emplace_back("greatest directional albedo, F = 1",
                          energy_text(measure.greatest_albedo, measure.mu, measure.roughness));
}

std::vector<Item> list_lobes(const Globals&) {
  std::vector<Item> items;
  for (const std::string& distribution : model_names("distribution")) {
    for (const std::string& masking : fitting_maskings(distribution)) {
      items.push_back({fmt::format("{},{}", distribution, masking),
                       "",
                       {{"distribution", distribution}, {"masking", masking}}});
    }
  }
  return items;
}

void measure_listed_lobe(Item& item) {
  const LobeMeasure measure = measure_lobe({item.facts[0].second, item.facts[1].second, 0});
  item.facts = {{"reciprocal", reciprocal_text(measure)},
                {"weak white furnace", furnace_text(measure)},
                {"greatest directional albedo, F = 1",
                 energy_text(measure.greatest_albedo, measure.mu, measure.roughness)}};
}

std::vector<Item> items_of(const std::vector<NamedText>& texts) {
  std::vector<Item> items;
  items.reserve(texts.size());
  for (const NamedText& text : texts) items.push_back({text.name, text.summary, text.facts});
  return items;
}

std::vector<Item> list_bakes(const Globals&) {
  std::vector<Item> items;
  for (const BakeFacts& bake : all_bakes()) {
    const std::string scope = bake.scope == Scope::Once ? "once" : "once per texture set";
    items.push_back({bake.name, bake.summary, {{"runs", scope}}, bake_block(bake).keys});
  }
  return items;
}

std::vector<Item> list_surface(const Globals&) {
  std::vector<Item> items;
  for (const ParamFacts& facts : facts_of(surface_params())) {
    Item item{kebab(facts.name), facts.meaning};
    if (const std::string range = range_text(facts); !range.empty()) {
      item.facts.emplace_back("takes", range);
    }
    if (!facts.default_text.empty()) item.facts.emplace_back("default", facts.default_text);
    items.push_back(std::move(item));
  }
  return items;
}

std::vector<Item> list_namings(const Globals&) {
  std::vector<Item> items;
  for (const NamingScheme& scheme : all_naming_schemes()) {
    Item item{std::string(scheme.name), std::string(scheme.meaning)};
    for (const NamingToken& token : scheme.tokens) {
      std::string targets;
      for (const TokenTarget& target : token.targets) {
        targets += fmt::format("{}{}[{}]", targets.empty() ? "" : " ", slot_name(target.slot),
                               target.channels);
      }
      item.facts.emplace_back(std::string(token.token), targets);
    }
    items.push_back(std::move(item));
  }
  return items;
}

std::vector<Item> list_slots(const Globals&) {
  std::vector<Item> items;
  for (const SlotFacts& slot : slot_list) {
    Item item{std::string(slot.name), std::string(slot.meaning)};
    if (!slot.aliases.empty()) item.facts.emplace_back("also", std::string(slot.aliases));
    items.push_back(std::move(item));
  }
  return items;
}

std::vector<Item> list_color_spaces(const Globals& globals) {
  const ColorConfig config(chosen_config(globals.ocio, ""));
  std::vector<Item> items;
  for (const std::string& space : config.color_spaces()) {
    items.push_back({space, config.is_data(space) ? "numbers, never converted" : ""});
  }
  return items;
}

const std::vector<Kind>& kinds() {
  static const std::vector<Kind> list = {
      {"models", "distributions, masking, Fresnel, diffuse and energy models, measured",
       list_models, measure_model},
      {"lobes", "distributions with the maskings that fit them, measured", list_lobes,
       measure_listed_lobe},
      {"tables", "what kiln lut integrates",
       [](const Globals&) { return items_of(list_tables()); }},
      {"axes", "how a table's axes may run",
       [](const Globals&) { return items_of(list_lut_axes()); }},
      {"channels", "what a table may hold",
       [](const Globals&) { return items_of(list_lut_channels()); }},
      {"presets", "layouts of engines for kiln lut",
       [](const Globals&) { return items_of(list_lut_presets()); }},
      {"curves", "roughness along the levels of kiln env",
       [](const Globals&) { return items_of(list_roughness_curves()); }},
      {"engines", "layouts of engines for kiln env",
       [](const Globals&) { return items_of(list_environment_presets()); }},
      {"environment-formats", "files that kiln env writes",
       [](const Globals&) { return items_of(list_environment_formats()); }},
      {"layouts", "layouts of engines for kiln bake pack",
       [](const Globals&) { return items_of(list_pack_presets()); }},
      {"surface", "models and numbers of a material", list_surface, [](Item&) {}},
      {"bakes", "what a pipeline file can make", list_bakes},
      {"namings", "schemes that tell a map's slot from its file name", list_namings},
      {"maps", "slots of a texture set", list_slots},
      {"colour-spaces", "of the OpenColorIO config in use", list_color_spaces}};
  return list;
}

void print_item(const Item& item) {
  fmt::print("{}  {}\n", item.name, item.summary);
  for (const auto& [name, text] : item.facts) fmt::print("  {}: {}\n", name, text);
  for (const Key& key : item.keys) {
    const ParamFacts& facts = key.facts;
    std::string line = fmt::format("  {:<15} {}", facts.name, facts.meaning);
    if (!facts.unit.empty()) line += " " + facts.unit;
    if (const std::string range = range_text(facts); !range.empty()) line += "; " + range;
    if (!facts.default_text.empty()) line += "; default " + facts.default_text;
    fmt::print("{}\n", line);
  }
}

Json to_json(const Item& item) {
  Json json = {{"name", item.name}, {"summary", item.summary}};
  if (!item.facts.empty()) json["facts"] = Json::array();
  for (const auto& [name, text] : item.facts) json["facts"].push_back({{name, text}});
  if (!item.keys.empty()) json["parameters"] = Json::array();
  for (const Key& key : item.keys) {
    json["parameters"].push_back({{"name", key.facts.name},
                                  {"meaning", key.facts.meaning},
                                  {"unit", key.facts.unit},
                                  {"range", range_text(key.facts)},
                                  {"default", key.facts.default_text}});
  }
  return json;
}

int print_kinds(const Globals& globals) {
  Json json = Json::array();
  for (const Kind& kind : kinds()) {
    json.push_back({{"kind", kind.name}, {"meaning", kind.meaning}});
    if (!globals.json) fmt::print("{:<14} {}\n", kind.name, kind.meaning);
  }
  json.push_back({{"kind", "schema"}, {"meaning", "JSON Schema of pipeline files"}});
  if (globals.json) {
    fmt::print("{}\n", json.dump(2));
  } else {
    fmt::print("{:<14} {}\n", "schema", "JSON Schema of pipeline files");
  }
  return 0;
}

int print_kind(const Kind& kind, const Globals& globals) {
  std::vector<Item> items = kind.items(globals);
  if (kind.measure) {
    for (Item& item : items) kind.measure(item);
  }
  if (globals.json) {
    Json json = Json::array();
    for (const Item& item : items) json.push_back(to_json(item));
    fmt::print("{}\n", json.dump(2));
    return 0;
  }
  if (kind.measure) {
    for (const Item& item : items) print_item(item);
    return 0;
  }
  size_t width = 0;
  for (const Item& item : items) width = std::max(width, item.name.size());
  for (const Item& item : items) fmt::print("{:<{}}  {}\n", item.name, width, item.summary);
  return 0;
}

int print_named(const std::string& name, const Globals& globals) {
  std::vector<std::string> known = {"schema"};
  bool found = false;
  for (const Kind& kind : kinds()) {
    known.push_back(kind.name);
    if (found && kind.name == "colour-spaces") break;  // a config is not read in vain
    for (Item& item : kind.items(globals)) {
      known.push_back(item.name);
      if (kebab(item.name) != kebab(name)) continue;
      found = true;
      if (kind.measure) kind.measure(item);
      if (globals.json) {
        fmt::print("{}\n", to_json(item).dump(2));
      } else {
        print_item(item);
      }
    }
  }
  if (!found) throw Error(Fault::Usage, unknown_name("kind or name", name, known));
  return 0;
}

// "color-spaces" is "colour-spaces", "bake" is "bakes".
bool names_kind(const std::string& word, const std::string& kind) {
  std::string spelled = kebab(word);
  if (const size_t at = spelled.find("color"); at != std::string::npos) {
    spelled.replace(at, 5, "colour");
  }
  return spelled == kind || spelled + "s" == kind;
}

int run(const std::string& word, const Globals& globals) {
  if (word.empty()) return print_kinds(globals);
  if (kebab(word) == "schema") {
    fmt::print("{}", schema_json());
    return 0;
  }
  for (const Kind& kind : kinds()) {
    if (names_kind(word, kind.name)) return print_kind(kind, globals);
  }
  return print_named(word, globals);
}

Action declare(CLI::App& app) {
  const auto word = std::make_shared<std::string>();
  app.add_option(
         "WORD", *word,
         "models, lobes, tables, axes, channels, presets, layouts, surface, bakes, namings, maps, "
         "colour-spaces, schema, or the name of one")
      ->type_name("");
  return [word](const Globals& globals) { return run(*word, globals); };
}

}  // namespace

Verb list_verb() { return {"list", "[KIND|NAME]", "what there is, and its parameters", declare}; }

}  // namespace kiln
