// SPDX-License-Identifier: Apache-2.0
#include "kiln/bake/lut.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "kiln/core/error.h"
#include "kiln/core/param.h"
#include "kiln/io/image_file.h"
#include "one_bake.h"
#include "verb.h"

namespace kiln {
namespace {

struct LutArguments {
  std::string table, output, at, snippet;
  std::unique_ptr<BakeOptions> options;
};

std::vector<double> parse_point(const std::string& text) {
  ParamFacts facts;
  facts.name = "--at";
  std::vector<double> point;
  for (size_t begin = 0; begin <= text.size();) {
    const size_t end = std::min(text.find(',', begin), text.size());
    point.push_back(parse_number(facts, text.substr(begin, end - begin)));
    begin = end + 1;
  }
  return point;
}

LutWords words_of(const LutArguments& arguments) {
  LutWords words = arguments.options->given();
  std::erase_if(words, [](const auto& word) { return word.first == "type"; });
  words.emplace_back("table", arguments.table);
  return words;
}

int print_point(const LutArguments& arguments, const Globals& globals) {
  const LutWords words = words_of(arguments);
  const std::vector<double> point = parse_point(arguments.at);
  const std::vector<PointValue> values = integrate_at(words, point);
  if (!globals.json) {
    std::string line;
    for (const PointValue& value : values) {
      line += fmt::format("{}{:.17g}", line.empty() ? "" : " ", value.value);
    }
    fmt::print("{}\n", line);
    return 0;
  }
  nlohmann::ordered_json json = {{"table", kebab(arguments.table)}};
  const std::vector<std::string> axes = lut_axes(words);
  for (size_t a = 0; a < axes.size(); ++a) json[axes[a]] = point[a];
  for (const PointValue& value : values) json[value.channel] = value.value;
  fmt::print("{}\n", json.dump(2));
  return 0;
}

// What --type says, or the preset prefers and the file's format holds.
bool is_rgbd(const LutArguments& arguments) {
  const LutWords given = arguments.options->given();
  std::string wanted, preset;
  for (const auto& [key, text] : given) {
    if (key == "type") wanted = kebab(text);
    if (key == "preset") preset = kebab(text);
  }
  if (!wanted.empty()) return wanted == "rgbd8";
  if (arguments.output.empty()) return false;
  const auto& held = writable_format(arguments.output).types;
  if (std::find(held.begin(), held.end(), PixelType::Rgbd8) == held.end()) return false;
  for (const NamedText& item : list_lut_presets()) {
    if (item.name == preset) return item.facts.front().second == "rgbd8";
  }
  return false;
}

int print_snippet(const LutArguments& arguments) {
  const std::string file = arguments.output.empty()
                               ? "table"
                               : std::filesystem::path(arguments.output).filename().string();
  fmt::print("{}", lut_snippet(words_of(arguments), arguments.snippet, file, is_rgbd(arguments)));
  return 0;
}

int run(const LutArguments& arguments, const Globals& globals) {
  if (arguments.table.empty()) {
    throw Error(Fault::Usage, "expected a TABLE (see kiln list tables)");
  }
  if (!arguments.at.empty()) return print_point(arguments, globals);
  if (arguments.output.empty() && arguments.snippet.empty()) {
    throw Error(Fault::Usage,
                "no output is given: -o FILE for a table, --at MU,ROUGHNESS for one "
                "value, --snippet for lookup code");
  }
  if (!arguments.output.empty()) {
    Pipeline pipeline;
    pipeline.bakes.push_back(arguments.options->choice({{"table", arguments.table}}));
    Globals quieter = globals;
    quieter.quiet = globals.quiet || !arguments.snippet.empty();
    const int code = run_one_bake(std::move(pipeline), arguments.output, quieter);
    if (code != 0) return code;
  }
  return arguments.snippet.empty() ? 0 : print_snippet(arguments);
}

Action declare(CLI::App& app) {
  const auto arguments = std::make_shared<LutArguments>();
  app.add_option("TABLE", arguments->table, "which integral (see kiln list tables)")->type_name("");
  app.add_option("-o,--output", arguments->output,
                 "file to make: .exr .png .hdr .tif .dds .ktx2 .npy .csv .h")
      ->type_name("FILE");
  app.add_option("--at", arguments->at, "print the integral there with 17 digits, make no file")
      ->type_name("MU,ROUGHNESS");
  app.add_option("--snippet", arguments->snippet, "print code that looks the table up")
      ->type_name("glsl|hlsl|cpp");
  arguments->options = std::make_unique<BakeOptions>(app, "lut", std::vector<std::string>{"table"});
  return [arguments](const Globals& globals) { return run(*arguments, globals); };
}

}  // namespace

Verb lut_verb() { return {"lut", "TABLE -o FILE", "one table of BRDF integrals", declare}; }

}  // namespace kiln
