// SPDX-License-Identifier: Apache-2.0
#include "kiln/bake/lut.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "bakes.h"
#include "kiln/brdf/models.h"
#include "kiln/table/lut.h"
#include "kiln/table/snippet.h"
#include "lut_presets.h"

namespace kiln {
namespace {

using Settings = LutBake::Settings;

struct FresnelNumber {
  const char* name;
  double FresnelChannel<double>::*member;
};
constexpr FresnelNumber fresnel_numbers[] = {
    {"f0", &FresnelChannel<double>::f0},   {"f90", &FresnelChannel<double>::f90},
    {"f82", &FresnelChannel<double>::f82}, {"edge_tint", &FresnelChannel<double>::edge_tint},
    {"ior", &FresnelChannel<double>::ior}, {"extinction", &FresnelChannel<double>::extinction},
    {"dip", &FresnelChannel<double>::dip}, {"exponent", &FresnelChannel<double>::exponent}};

const ModelFacts* find_fresnel(const std::string& name) {
  for (const ModelFacts& model : all_models()) {
    if (model.family == "fresnel" && model.name == name) return &model;
  }
  return nullptr;
}

bool reads(const ModelFacts& model, std::string_view number) {
  return std::any_of(model.params.begin(), model.params.end(),
                     [&](const ModelParam& param) { return param.name == number; });
}

// A number of the Fresnel term, with the range and meaning that its models state.
Param<Settings> fresnel_param(const FresnelNumber& number) {
  ParamFacts facts;
  facts.name = number.name;
  facts.kind = ParamFacts::Kind::Number;
  facts.default_text = number_text(FresnelChannel<double>{}.*number.member);
  for (const ModelFacts& model : all_models()) {
    for (const ModelParam& param : model.params) {
      if (model.family != "fresnel" || param.name != facts.name) continue;
      facts.min = param.min;
      facts.max = param.max;
      facts.meaning = std::string(param.meaning);
    }
  }
  return {facts, [facts, number](Settings& settings, const std::string& text) {
            settings.fresnel_numbers.*number.member = parse_number(facts, text);
          }};
}

// "128", "128x32": shown as the kind's default.
Param<Settings> size_param() {
  Param<Settings> param = extent_param("size", &Settings::size, {2, 8192},
                                       "entries along x and y, if not the table's own");
  param.facts.default_text.clear();  // the table's or the preset's
  return param;
}

std::vector<std::string> words_of(const std::string& text) {
  std::vector<std::string> words;
  for (size_t begin = 0; begin <= text.size();) {
    const size_t end = std::min(text.find(',', begin), text.size());
    words.push_back(kebab(text.substr(begin, end - begin)));
    begin = end + 1;
  }
  return words;
}

// What is given takes the place of what was.
void overlay(TableRecipe& recipe, const Settings& given) {
  Lobe& lobe = recipe.models.lobe;
  if (!given.axes.empty()) recipe.axes = words_of(given.axes);
  if (!given.channels.empty()) recipe.channels = words_of(given.channels);
  if (given.size != Size{}) recipe.size = given.size;
  if (given.depth > 0) recipe.depth = given.depth;
  if (!given.align.empty()) {
    recipe.alignment = given.align == "corner" ? Alignment::Corner : Alignment::Center;
  }
  if (!given.origin.empty()) {
    recipe.origin = given.origin == "bottom" ? Origin::Bottom : Origin::Top;
  }
  if (!given.distribution.empty()) lobe.distribution = given.distribution;
  if (!given.masking.empty()) lobe.masking = given.masking;
  if (given.shape != 0) lobe.shape = given.shape;
  if (!given.fresnel.empty()) recipe.models.fresnel.name = given.fresnel;
  recipe.models.fresnel.parameters = given.fresnel_numbers;
  recipe.exact = given.exact;
}

// Cloth has its own masking: a distribution chosen alone brings one that fits it.
void choose_masking(TableRecipe& recipe, const Settings& given) {
  if (given.distribution == "charlie" && given.masking.empty()) {
    recipe.models.lobe.masking = "neubelt";
  }
}

TableRecipe resolve(const Settings& settings) {
  const TableFacts& facts = find_table(settings.table);
  TableRecipe recipe = recipe_of(facts);
  if (!settings.preset.empty()) {
    const LutPreset::Table& table = preset_table(find_lut_preset(settings.preset), settings.table);
    Settings preset;
    for (const auto& [key, text] : table.settings) assign(LutBake::params(), preset, key, text);
    overlay(recipe, preset);
  }
  overlay(recipe, settings);
  choose_masking(recipe, settings);
  complete(recipe);
  return recipe;
}

std::string fresnel_text(const TableRecipe& recipe) {
  const FresnelChoice& fresnel = recipe.models.fresnel;
  const auto& channels = recipe.channels;
  if (const ModelFacts* model = find_fresnel(fresnel.name)) {
    std::string text = fresnel.name;
    for (const FresnelNumber& number : fresnel_numbers) {
      if (!reads(*model, number.name)) continue;
      text += fmt::format(" {}={:g}", number.name, fresnel.parameters.*number.member);
    }
    return text;
  }
  return std::count(channels.begin(), channels.end(), "bias") > 0 ? "schlick" : "1";
}

using Attributes = std::vector<std::pair<std::string, std::string>>;

void describe_axes(const LutSource& lut, Attributes& attributes) {
  std::vector<std::string> axes;
  for (size_t a = 0; a < lut.axes().size(); ++a) {
    axes.push_back(fmt::format("{}={} ({})", "xyz"[a], lut.axes()[a].mapping.name,
                               lut.axes()[a].mapping.meaning));
  }
  attributes.emplace_back("kiln:axes", fmt::format("{}", fmt::join(axes, ", ")));
  attributes.emplace_back("kiln:alignment", lut.recipe().alignment == Alignment::Center
                                                ? "center: u = (i + 0.5) / N"
                                                : "corner: u = i / (N - 1)");
  attributes.emplace_back("kiln:origin", lut.recipe().origin == Origin::Top
                                             ? "top: the first row has the least u"
                                             : "bottom: the last row has the least u");
  if (lut.recipe().depth > 1) {
    attributes.emplace_back("kiln:depth", std::to_string(lut.recipe().depth));
  }
}

Attributes describe_file(const Settings& settings, const LutSource& lut, const LutErrors& errors) {
  const Lobe& lobe = lut.recipe().models.lobe;
  Attributes attributes = {
      {"kiln:table", lut.recipe().table},
      {"kiln:models", fmt::format("distribution={} masking={} fresnel={}", lobe.distribution,
                                  lobe.masking, fresnel_text(lut.recipe()))}};
  if (!settings.preset.empty()) attributes.emplace_back("kiln:preset", settings.preset);
  describe_axes(lut, attributes);
  const std::vector<std::string> names = plane_names(lut.recipe().channels.size());
  for (size_t c = 0; c < names.size(); ++c) {
    attributes.emplace_back("kiln:channel_" + names[c],
                            find_channel(lut.recipe().channels[c]).meaning);
  }
  if (errors.fit > 0) {
    attributes.emplace_back(
        "kiln:fit_error",
        fmt::format("{:.3g}, mean share of light that the fit sends elsewhere", errors.fit));
    return attributes;
  }
  attributes.emplace_back("kiln:entry_error",
                          fmt::format("{:.3g}, greatest of {} entries spread evenly, against a "
                                      "higher order",
                                      errors.entry, errors.entries_checked));
  attributes.emplace_back(
      "kiln:lookup_error",
      fmt::format("{:.3g} for mu in [0.001,1], roughness in [0.01,1]; {:.3g} for mu in [0.05,1], "
                  "roughness in [0.1,1]; linear, clamped",
                  errors.lookup, errors.lookup_inner));
  return attributes;
}

// Volumes too large to be made at once.
ImageBands bands_of(const std::shared_ptr<LutSource>& lut) {
  const Size slice = lut->recipe().size;
  return {{slice.width, slice.height * lut->slices()},
          plane_names(lut->recipe().channels.size()),
          slice.height * lut->slices_at_once(),
          [lut, slice](int first, int rows) {
            return lut->image(first / slice.height, rows / slice.height);
          }};
}

Artifact make_artifact(const Settings& settings, const std::shared_ptr<LutSource>& lut,
                       const LutErrors& errors) {
  Artifact artifact;
  if (lut->slices_at_once() == lut->slices()) {
    artifact.image = lut->image(0, lut->slices());
  } else {
    artifact.bands = bands_of(lut);
  }
  artifact.attributes = describe_file(settings, *lut, errors);
  artifact.depth = lut->recipe().depth;
  for (const TableAxis& axis : lut->axes()) {
    artifact.axes.emplace_back(quantity_name(axis.mapping.quantity), axis.coordinates);
  }
  for (const std::string& channel : lut->recipe().channels) {
    artifact.channel_names.push_back(find_channel(channel).name);
  }
  if (!settings.preset.empty()) {
    artifact.preferred_type = find_lut_preset(settings.preset).pixel_type;
  }
  return artifact;
}

}  // namespace

Params<Settings> LutBake::params() {
  Params<Settings> params = {
      choice_param("table", &Settings::table, table_names(), "what is integrated"),
      choice_param("preset", &Settings::preset, lut_preset_names(), "layout of an engine"),
      size_param(),
      integer_param("depth", &Settings::depth, {0, 1024}, "slices of a 3-D table; 0: its own"),
      text_param("axes", &Settings::axes, "mappings of x, y, z (kiln list axes)"),
      choice_param("align", &Settings::align, {"center", "corner"}, "where entries lie"),
      choice_param("origin", &Settings::origin, {"top", "bottom"}, "row of the least y"),
      text_param("channels", &Settings::channels, "what each holds (kiln list channels)"),
      choice_param("distribution", &Settings::distribution, model_names("distribution"),
                   "microfacet normals"),
      choice_param("masking", &Settings::masking, model_names("masking"), "masking and shadowing"),
      number_param("shape", &Settings::shape, {0, 1000}, "",
                   "of distributions that have one; 0: its default"),
      choice_param("fresnel", &Settings::fresnel, model_names("fresnel"),
                   "Fresnel term of reflectances, instead of F = 1"),
      flag_param("exact", &Settings::exact, "entries to 1e-10 instead of 1e-6"),
  };
  for (const FresnelNumber& number : fresnel_numbers) params.push_back(fresnel_param(number));
  return params;
}

Needs LutBake::needs(const Settings& settings) {
  resolve(settings);
  return {};
}

Baked LutBake::bake(const Settings& settings, const Ingredients&) {
  const auto lut = std::make_shared<LutSource>(resolve(settings));
  const LutErrors errors = errors_of(*lut);
  Baked baked;
  baked.figures = {{"entry error", errors.entry},
                   {"lookup error", errors.lookup},
                   {"lookup error, mu >= 0.05 and roughness >= 0.1", errors.lookup_inner}};
  if (errors.fit > 0) baked.figures = {{"fit error, mean share of light elsewhere", errors.fit}};
  if (!settings.preset.empty()) baked.notes = find_lut_preset(settings.preset).cautions;
  baked.artifacts.push_back(make_artifact(settings, lut, errors));
  return baked;
}

namespace {

Settings settings_of(const LutWords& words) {
  Settings settings;
  for (const auto& [key, text] : words) assign(LutBake::params(), settings, key, text);
  return settings;
}

void check_point(Quantity quantity, double value) {
  const double low = quantity == Quantity::Mu ? least_mu : quantity == Quantity::Cosine ? -1 : 0;
  const double high = quantity == Quantity::Ior ? 100 : 1;
  if (value >= low && value <= high) return;
  throw Error(Fault::Usage, fmt::format("--at: found {} {}, expected {} to {}",
                                        quantity_name(quantity), value, low, high));
}

}  // namespace

std::vector<PointValue> integrate_at(const LutWords& words, const std::vector<double>& point) {
  const TableRecipe recipe = resolve(settings_of(words));
  std::vector<std::string> names;
  for (const std::string& axis : recipe.axes) {
    names.push_back(quantity_name(find_axis_mapping(axis).quantity));
  }
  if (point.size() != names.size()) {
    throw Error(Fault::Usage, fmt::format("--at: found {} numbers, expected {}", point.size(),
                                          fmt::join(names, ",")));
  }
  for (size_t a = 0; a < point.size(); ++a) {
    check_point(find_axis_mapping(recipe.axes[a]).quantity, point[a]);
  }
  const std::vector<double> values = integrate_at(recipe, point);
  std::vector<PointValue> named;
  named.reserve(values.size());
  for (size_t c = 0; c < values.size(); ++c) named.push_back({recipe.channels[c], values[c]});
  return named;
}

std::vector<std::string> lut_axes(const LutWords& words) {
  std::vector<std::string> names;
  for (const std::string& axis : resolve(settings_of(words)).axes) {
    names.push_back(quantity_name(find_axis_mapping(axis).quantity));
  }
  return names;
}

std::string lut_snippet(const LutWords& words, const std::string& language, const std::string& file,
                        bool rgbd) {
  const std::vector<std::string> languages = {"glsl", "hlsl", "cpp"};
  ParamFacts facts;
  facts.name = "--snippet";
  facts.choices = languages;
  const auto chosen = static_cast<SnippetLanguage>(parse_word(facts, language));
  LutSource lut(resolve(settings_of(words)));
  return lookup_snippet(lut, chosen, file, rgbd);
}

std::vector<NamedText> list_tables() {
  std::vector<NamedText> tables;
  for (const TableFacts& facts : all_tables()) {
    NamedText table{facts.name, facts.summary, {}};
    for (size_t a = 0; a < facts.axes.size(); ++a) {
      table.facts.emplace_back(std::string(1, "xyz"[a]), find_axis_mapping(facts.axes[a]).meaning);
    }
    for (const std::string& channel : facts.channels) {
      table.facts.emplace_back("channel", find_channel(channel).meaning);
    }
    table.facts.emplace_back("source", facts.source);
    tables.push_back(std::move(table));
  }
  return tables;
}

std::vector<NamedText> list_lut_axes() {
  std::vector<NamedText> axes;
  for (const AxisMapping& mapping : all_axis_mappings()) {
    axes.push_back({mapping.name, mapping.meaning, {}});
  }
  return axes;
}

std::vector<NamedText> list_lut_channels() {
  std::vector<NamedText> channels;
  for (const ChannelFacts& channel : all_channels()) {
    std::vector<std::string> over;
    for (const Quantity quantity : channel.over) over.push_back(quantity_name(quantity));
    channels.push_back(
        {channel.name,
         channel.meaning,
         {{"over", over.empty() ? "nothing" : fmt::format("{}", fmt::join(over, ", "))}}});
  }
  return channels;
}

std::vector<NamedText> list_lut_presets() {
  std::vector<NamedText> presets;
  for (const LutPreset& preset : all_lut_presets()) {
    NamedText item{preset.name, preset.summary, {{"type", preset.pixel_type}}};
    for (const LutPreset::Table& table : preset.tables) {
      std::vector<std::string> settings;
      for (const auto& [key, text] : table.settings)
        settings.push_back(fmt::format("{}={}", key, text));
      item.facts.emplace_back(table.table, fmt::format("{}", fmt::join(settings, " ")));
    }
    for (const std::string& caution : preset.cautions) item.facts.emplace_back("note", caution);
    presets.push_back(std::move(item));
  }
  return presets;
}

}  // namespace kiln
