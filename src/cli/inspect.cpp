// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "kiln/core/error.h"
#include "kiln/io/image_rows.h"
#include "kiln/material/slots.h"
#include "kiln/pipeline/document.h"
#include "material_options.h"
#include "print_error.h"
#include "verb.h"

namespace kiln {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

// Of the finite texels.
struct ChannelFacts {
  std::string name;
  float min = std::numeric_limits<float>::infinity();
  float max = -std::numeric_limits<float>::infinity();
  double sum = 0;
  long long count = 0;

  double mean() const { return count > 0 ? sum / static_cast<double>(count) : 0; }
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

void add_texels(const Plane& plane, ChannelFacts& facts) {
  for (int y = 0; y < plane.height(); ++y) {
    for (const float value : plane.texels_of_row(y)) {
      if (!std::isfinite(value)) continue;
      facts.min = std::min(facts.min, value);
      facts.max = std::max(facts.max, value);
      facts.sum += value;
      ++facts.count;
    }
  }
}

void add_rows(const Layers& rows, Inspected& inspected) {
  inspected.channels.resize(rows.layers.size());
  for (size_t i = 0; i < rows.layers.size(); ++i) {
    inspected.channels[i].name = rows.layers[i].name;
    add_texels(rows.layers[i].plane, inspected.channels[i]);
  }
  const Oddities found = count_oddities(rows);
  inspected.oddities.nan += found.nan;
  inspected.oddities.inf += found.inf;
  inspected.oddities.negative += found.negative;
}

std::string assumed_space(const PlannedMap& map, PixelType type) {
  if (slot_facts(map.slot).content == Content::Numbers) return "data";
  if (!map.color_space.empty()) return map.color_space;
  return type == PixelType::Half || type == PixelType::Float ? "lin_rec709_scene"
                                                             : "srgb_rec709_scene";
}

Inspected inspected_rows(const fs::path& path, ImageRows source) {
  constexpr int rows_at_once = 64;
  Inspected inspected;
  inspected.file = path.string();
  const int height = source.facts().size.height;
  for (int y = 0; y < height; y += rows_at_once) {
    add_rows(source.next(std::min(rows_at_once, height - y)), inspected);
  }
  inspected.facts = source.facts();
  return inspected;
}

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

std::vector<PlannedMap> maps_in(const PlannedSet& set, const fs::path& path) {
  std::vector<PlannedMap> maps;
  for (const PlannedMap& map : set.maps) {
    if (map.path == path) maps.push_back(map);
  }
  return maps;
}

std::vector<fs::path> files_of(const PlannedSet& set) {
  std::vector<fs::path> files;
  for (const PlannedMap& map : set.maps) {
    if (map.path.empty() || std::count(files.begin(), files.end(), map.path) > 0) continue;
    files.push_back(map.path);
  }
  return files;
}

Inspected inspected_maps(const std::vector<PlannedMap>& maps) {
  const PlannedMap& first = maps.front();
  Inspected inspected = inspected_rows(
      first.path, first.embedded.bytes ? ImageRows(first.embedded) : ImageRows(first.path));
  for (const PlannedMap& map : maps) {
    if (map.if_present && !has_channels(inspected.facts.channels, map.channels)) continue;
    inspected.uses.push_back({fmt::format("{}[{}]", slot_name(map.slot), map.channels),
                              map.reason + scaled_text(map.decoding),
                              assumed_space(map, inspected.facts.type)});
  }
  return inspected;
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
               channel.mean(), channel.max);
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
                        {"mean", channel.mean()},
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
  return fs::is_directory(path) || is_material_file(path) || is_material_document(path);
}

void print_heading(const PlannedSet& set) {
  fmt::print("set {}: {} ({})\n", set.name, workflow_name(set.reading.workflow),
             set.workflow_reason);
  for (const IgnoredFile& file : set.ignored) {
    fmt::print("  not used: {}: {}\n", file.file, file.reason);
  }
  for (const std::string& warning : set.warnings) fmt::print("  warning: {}\n", warning);
  print_constants(set);
}

// Prints what is asked for, or gathers it; what cannot be read is told, and costs nothing else.
class Inspection {
 public:
  explicit Inspection(const Globals& globals) : is_json_(globals.json) {}

  void file(const fs::path& path) {
    attempt([&] { keep(inspected_rows(path, ImageRows(path))); });
  }

  void material(const MaterialOptions& options) {
    attempt([&] {
      Pipeline pipeline;
      options.add_to(pipeline);
      for (const PlannedSet& set : planned_sets(pipeline)) {
        attempt([&] { this->set(set); });
      }
    });
  }

  // The first error's, where there was one.
  int end() const {
    if (is_json_) fmt::print("{}\n", json_.dump(2));
    return code_;
  }

 private:
  void set(const PlannedSet& set) {
    if (set.fault) throw Error(*set.fault);
    if (!is_json_) print_heading(set);
    for (const fs::path& path : files_of(set)) {
      attempt([&] { keep(inspected_maps(maps_in(set, path))); });
    }
  }

  void keep(const Inspected& inspected) {
    if (is_json_) {
      json_.push_back(to_json(inspected));
    } else {
      print_text(inspected);
    }
  }

  template <class Work>
  void attempt(Work&& work) {
    const std::optional<Error> fault = error_leaving(std::forward<Work>(work));
    if (!fault) return;
    print_error(fault->what());
    if (code_ == 0) code_ = exit_code(fault->fault());
  }

  bool is_json_;
  Json json_ = Json::array();
  int code_ = 0;
};

int run(const InspectArguments& arguments, const Globals& globals) {
  if (arguments.paths.empty()) throw Error(Fault::Usage, "expected a FILE or a MATERIAL");
  Inspection inspection(globals);
  for (const std::string& path : arguments.paths) {
    if (!is_material(path) && arguments.material.packed.empty()) {
      inspection.file(path);
      continue;
    }
    MaterialOptions material = arguments.material;
    material.path = path;
    inspection.material(material);
  }
  return inspection.end();
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
