// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>

#include "kiln/core/error.h"
#include "kiln/io/image_file.h"
#include "kiln/material/slots.h"
#include "material_options.h"
#include "verb.h"

namespace kiln {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

struct ChannelFacts {
  std::string name;
  float min = std::numeric_limits<float>::infinity();
  float max = -std::numeric_limits<float>::infinity();
  double mean = 0;  ///< of the finite texels
};

/// What a file, or a channel of it, was taken for.
struct Use {
  std::string slot;     ///< "roughness[g]"
  std::string reason;   ///< why
  std::string assumed;  ///< colour space
};

struct Inspected {
  std::string file;
  std::vector<Use> uses;  ///< none where the file was asked for by itself
  FileFacts facts;
  std::vector<ChannelFacts> channels;
  Oddities oddities;
};

ChannelFacts measure(const Layer& layer) {
  ChannelFacts facts{layer.name};
  long long finite = 0;
  double sum = 0;
  for (int y = 0; y < layer.plane.height(); ++y) {
    for (const float value : layer.plane.texels_of_row(y)) {
      if (!std::isfinite(value)) continue;
      facts.min = std::min(facts.min, value);
      facts.max = std::max(facts.max, value);
      sum += value;
      ++finite;
    }
  }
  facts.mean = finite > 0 ? sum / static_cast<double>(finite) : 0;
  return facts;
}

std::string assumed_space(const PlannedMap& map, PixelType type) {
  if (slot_facts(map.slot).content == Content::Numbers) return "data";
  if (!map.color_space.empty()) return map.color_space;
  return type == PixelType::Half || type == PixelType::Float ? "lin_rec709_scene"
                                                             : "srgb_rec709_scene";
}

Inspected inspected_image(const fs::path& path, ImageFile file) {
  Inspected inspected;
  inspected.file = path.string();
  inspected.facts = std::move(file.facts);
  inspected.oddities = count_oddities(file.image);
  for (const Layer& layer : file.image.layers) inspected.channels.push_back(measure(layer));
  return inspected;
}

Inspected inspect_file(const fs::path& path) { return inspected_image(path, read_image(path)); }

// ", times 0.5, plus 0.5", or nothing.
std::string scaled_text(const SlotDecoding& decoding) {
  const SlotDecoding plain;
  std::string text;
  const auto numbers = [](const std::array<float, 3>& v) {
    return v[0] == v[1] && v[1] == v[2] ? fmt::format("{:.6g}", v[0])
                                        : fmt::format("{:.6g} {:.6g} {:.6g}", v[0], v[1], v[2]);
  };
  if (decoding.scale != plain.scale) text += ", times " + numbers(decoding.scale);
  if (decoding.offset != plain.offset) text += ", plus " + numbers(decoding.offset);
  return text;
}

void print_constants(const PlannedSet& set) {
  for (const PlannedMap& map : set.maps) {
    if (!map.path.empty() || !map.value) continue;
    fmt::print("  {}: constant {:.6g} {:.6g} {:.6g} ({}{})\n", slot_name(map.slot), (*map.value)[0],
               (*map.value)[1], (*map.value)[2], map.reason, scaled_text(map.decoding));
  }
  if (set.alpha_cutoff) fmt::print("  cutout where opacity is below {:.6g}\n", *set.alpha_cutoff);
  const Wrap wrap = settled(set.reading.wrap);
  if (wrap != Wrap::Repeat) fmt::print("  wrap: {}\n", wrap_names[static_cast<size_t>(wrap)]);
}

std::vector<Inspected> inspect_set(const PlannedSet& set) {
  if (set.fault) throw Error(*set.fault);
  std::vector<Inspected> list;
  for (const PlannedMap& map : set.maps) {
    if (map.path.empty()) continue;
    const std::string path = map.path.string();
    auto found = std::find_if(list.begin(), list.end(),
                              [&](const Inspected& other) { return other.file == path; });
    if (found == list.end()) {
      found = list.insert(list.end(),
                          inspected_image(map.path, map.embedded.bytes ? read_image(map.embedded)
                                                                       : read_image(map.path)));
    }
    if (map.if_present && !has_channels(found->facts.channels, map.channels)) continue;
    found->uses.push_back({fmt::format("{}[{}]", slot_name(map.slot), map.channels),
                           map.reason + scaled_text(map.decoding),
                           assumed_space(map, found->facts.type)});
  }
  return list;
}

void print_text(const Inspected& inspected) {
  const FileFacts& facts = inspected.facts;
  fmt::print("{}\n  {} {}x{} {}, tagged {}\n", inspected.file, facts.format, facts.size.width,
             facts.size.height, pixel_type_name(facts.type),
             facts.color_space_tag.value_or("nothing"));
  for (const Use& use : inspected.uses) {
    fmt::print("  {}: {}; read as {}\n", use.slot, use.reason, use.assumed);
  }
  for (const ChannelFacts& channel : inspected.channels) {
    fmt::print("  {:<10} min {:<12.6g} mean {:<12.6g} max {:.6g}\n", channel.name, channel.min,
               channel.mean, channel.max);
  }
  const Oddities& odd = inspected.oddities;
  if (odd.nan + odd.inf + odd.negative > 0) {
    fmt::print("  {} NaN, {} infinite, {} negative\n", odd.nan, odd.inf, odd.negative);
  }
  for (const std::string& note : facts.notes) fmt::print("  note: {}\n", note);
}

Json to_json(const Inspected& inspected) {
  const FileFacts& facts = inspected.facts;
  Json channels = Json::array();
  for (const ChannelFacts& channel : inspected.channels) {
    channels.push_back({{"name", channel.name},
                        {"min", channel.min},
                        {"mean", channel.mean},
                        {"max", channel.max}});
  }
  Json uses = Json::array();
  for (const Use& use : inspected.uses) {
    uses.push_back({{"slot", use.slot}, {"reason", use.reason}, {"assumed", use.assumed}});
  }
  return {{"file", inspected.file},
          {"uses", uses},
          {"tagged", facts.color_space_tag.value_or("")},
          {"format", facts.format},
          {"size", {facts.size.width, facts.size.height}},
          {"type", std::string(pixel_type_name(facts.type))},
          {"channels", channels},
          {"nan", inspected.oddities.nan},
          {"inf", inspected.oddities.inf},
          {"negative", inspected.oddities.negative},
          {"notes", facts.notes}};
}

struct InspectArguments {
  std::vector<std::string> paths;
  MaterialOptions material;
};

bool is_material(const fs::path& path) {
  const std::string extension = path.extension().string();
  return fs::is_directory(path) || extension == ".yaml" || extension == ".yml" ||
         extension == ".json" || is_material_document(path);
}

std::vector<Inspected> inspect_material(const MaterialOptions& options, const Globals& globals) {
  Pipeline pipeline;
  options.add_to(pipeline);
  std::vector<Inspected> all;
  for (const PlannedSet& set : planned_sets(pipeline)) {
    if (!globals.json) {
      fmt::print("set {}: {} ({})\n", set.name, workflow_name(set.reading.workflow),
                 set.workflow_reason);
      for (const IgnoredFile& file : set.ignored) {
        fmt::print("  not used: {}: {}\n", file.file, file.reason);
      }
      for (const std::string& warning : set.warnings) fmt::print("  warning: {}\n", warning);
      print_constants(set);
    }
    for (Inspected& inspected : inspect_set(set)) {
      if (!globals.json) print_text(inspected);
      all.push_back(std::move(inspected));
    }
  }
  return all;
}

int run(const InspectArguments& arguments, const Globals& globals) {
  if (arguments.paths.empty()) throw Error(Fault::Usage, "expected a FILE or a MATERIAL");
  Json json = Json::array();
  for (const std::string& path : arguments.paths) {
    if (!is_material(path) && arguments.material.packed.empty()) {
      const Inspected inspected = inspect_file(path);
      if (!globals.json) print_text(inspected);
      json.push_back(to_json(inspected));
      continue;
    }
    MaterialOptions material = arguments.material;
    material.path = path;
    for (const Inspected& inspected : inspect_material(material, globals)) {
      json.push_back(to_json(inspected));
    }
  }
  if (globals.json) fmt::print("{}\n", json.dump(2));
  return 0;
}

Action declare(CLI::App& app) {
  const auto arguments = std::make_shared<InspectArguments>();
  app.add_option("PATH", arguments->paths, "images, folders of maps, or material files")
      ->type_name("...");
  arguments->material.declare(app);
  return [arguments](const Globals& globals) { return run(*arguments, globals); };
}

}  // namespace

Verb inspect_verb() { return {"inspect", "FILE|MATERIAL...", "what is in these maps", declare}; }

}  // namespace kiln
