// SPDX-License-Identifier: Apache-2.0
#include "kiln/validate/verify.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "kiln/core/error.h"
#include "kiln/core/param.h"
#include "kiln/io/number_arrays.h"
#include "kiln/validate/error_picture.h"
#include "verb.h"

namespace kiln {
namespace {

using Json = nlohmann::ordered_json;

struct VerifyArguments {
  std::string file, max_error, map;
};

Json to_json(const ChannelMatch& channel) {
  return {{"channel", channel.channel},
          {"holds", channel.quantity},
          {"distribution", channel.distribution},
          {"masking", channel.masking},
          {"known", channel.known},
          {"max_error", channel.max_error},
          {"rms_error", channel.rms_error}};
}

Json to_json(const Match& match) {
  Json json = {{"table", match.table_class},   {"convention", match.convention},
               {"array", match.array},         {"arrangement", match.arrangement},
               {"decoding", match.decoding},   {"transposed", match.axes.transposed},
               {"max_error", match.max_error}, {"rms_error", match.rms_error}};
  json["at"] = {{"mu", match.mu},
                {"roughness", match.roughness},
                {"x", match.x},
                {"y", match.y},
                {"channel", match.channel}};
  json["channels"] = Json::array();
  for (const ChannelMatch& channel : match.channels) json["channels"].push_back(to_json(channel));
  return json;
}

Json to_json(const std::string& file, const Verdict& verdict) {
  Json json = {{"file", file}, {"fits", verdict.fits}, {"within", verdict.within}};
  if (!verdict.fits) json["verdict"] = "no convention fits";
  json[verdict.fits ? "best" : "nearest"] = to_json(verdict.best);
  if (verdict.runner_up) {
    json["runner_up"] = to_json(*verdict.runner_up);
    json["ratio"] = verdict.ratio;
  }
  json["others"] = Json::array();
  for (const Match& other : verdict.others) json["others"].push_back(to_json(other));
  json["statements"] = verdict.statements;
  json["presets"] = verdict.presets;
  return json;
}

void print_channel(const ChannelMatch& channel) {
  const std::string lobe =
      channel.distribution.empty()
          ? ""
          : fmt::format(" of {} with {}", channel.distribution, channel.masking);
  if (channel.known && !channel.constant) {
    fmt::print("  channel {:<5} {}{}; greatest error {:.3g}, rms {:.3g}\n", channel.channel,
               channel.quantity, lobe, channel.max_error, channel.rms_error);
  } else {
    fmt::print("  channel {:<5} {}\n", channel.channel, channel.quantity);
  }
}

void print_statements(const Verdict& verdict) {
  for (const std::string& statement : verdict.statements) fmt::print("  - {}\n", statement);
}

void print_verdict(const std::string& file, const Verdict& verdict) {
  if (!verdict.fits) {
    fmt::print("{}: no convention fits\n", file);
    return print_statements(verdict);
  }
  const Match& best = verdict.best;
  fmt::print("{}: {}\n", file, best.table_class);
  if (!best.array.empty()) fmt::print("  array         {}\n", best.array);
  fmt::print("  convention    {}\n", best.convention);
  for (const ChannelMatch& channel : best.channels) print_channel(channel);
  fmt::print("  errors        greatest {:.3g}, rms {:.3g}, against the exact integral\n",
             best.max_error, best.rms_error);
  fmt::print("  greatest at   entry {},{} of channel {}: n.v {:.4g}, roughness {:.4g}\n", best.x,
             best.y, best.channel, best.mu, best.roughness);
  if (verdict.runner_up) {
    fmt::print("  next best     {} times the rms error: {}\n", fmt::format("{:.3g}", verdict.ratio),
               verdict.runner_up->convention);
  }
  if (!verdict.presets.empty()) {
    fmt::print("  presets       {}\n", fmt::join(verdict.presets, ", "));
  }
  for (const Match& other : verdict.others) {
    fmt::print("  also holds    {}: {}; greatest error {:.3g}\n", other.array, other.table_class,
               other.max_error);
  }
  print_statements(verdict);
}

double parse_max_error(const std::string& text) {
  if (text.empty()) return 0;
  ParamFacts facts;
  facts.name = "--max-error";
  facts.min = 0;
  return parse_number(facts, text);
}

// Numbers as they are, or a picture for looking.
void write_map(const std::string& path, const Verdict& verdict) {
  const WritableFormat& format = writable_format(path);
  const bool picture = format.name == "png" || format.name == "jpeg";
  WriteOptions options;
  options.type = picture ? PixelType::Uint8 : format.types.back();
  write_image(path, picture ? error_picture(verdict) : verdict.errors, options);
}

int run(const VerifyArguments& arguments, const Globals& globals) {
  if (arguments.file.empty()) throw Error(Fault::Usage, "expected a FILE that holds a table");
  const double max_error = parse_max_error(arguments.max_error);
  const Verdict verdict = verify_tables(read_arrays(arguments.file), {max_error});
  if (globals.json) {
    fmt::print("{}\n", to_json(arguments.file, verdict).dump(2));
  } else if (!globals.quiet) {
    print_verdict(arguments.file, verdict);
  }
  if (!arguments.map.empty() && verdict.fits) write_map(arguments.map, verdict);
  return verdict.fits && verdict.within ? 0 : exit_code(Fault::Difference);
}

Action declare(CLI::App& app) {
  const auto arguments = std::make_shared<VerifyArguments>();
  app.add_option("FILE", arguments->file,
                 "a table: exr hdr png tif dds ktx ktx2 npy csv, C header, JavaScript")
      ->type_name("");
  app.add_option("--max-error", arguments->max_error, "exit with 7 where the table errs by more")
      ->type_name("X");
  app.add_option("--map", arguments->map, "write stored less exact: exr as numbers, png to look at")
      ->type_name("FILE");
  return [arguments](const Globals& globals) { return run(*arguments, globals); };
}

}  // namespace

Verb verify_verb() {
  return {"verify", "FILE", "what anybody's BRDF table is, and how wrong", declare};
}

}  // namespace kiln
