// SPDX-License-Identifier: Apache-2.0
#include "kiln/bake/lut.h"

#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "kiln/core/error.h"
#include "kiln/core/param.h"
#include "one_task.h"
#include "verb.h"

namespace kiln {
namespace {

struct LutArguments {
  std::string table, output, at;
  std::unique_ptr<BakeOptions> options;
};

struct Point {
  double mu = 0, roughness = 0;
};

Point parse_point(const std::string& text) {
  const size_t comma = text.find(',');
  if (comma == std::string::npos) {
    throw Error(Fault::Usage, fmt::format("--at: found '{}', expected MU,ROUGHNESS", text));
  }
  ParamFacts mu, roughness;
  mu.name = "--at, mu";
  roughness.name = "--at, roughness";
  return {parse_number(mu, text.substr(0, comma)), parse_number(roughness, text.substr(comma + 1))};
}

std::string first_word(const std::string& text) { return text.substr(0, text.find(':')); }

int print_point(const LutArguments& arguments, const Globals& globals) {
  const Point point = parse_point(arguments.at);
  const std::vector<double> values = integrate_at(arguments.table, point.mu, point.roughness);
  const std::vector<std::string> channels = table_channels(arguments.table);
  if (!globals.json) {
    std::string line;
    for (const double value : values)
      line += fmt::format("{}{:.17g}", line.empty() ? "" : " ", value);
    fmt::print("{}\n", line);
    return 0;
  }
  nlohmann::ordered_json json = {
      {"table", kebab(arguments.table)}, {"mu", point.mu}, {"roughness", point.roughness}};
  for (size_t i = 0; i < values.size(); ++i) json[first_word(channels.at(i))] = values[i];
  fmt::print("{}\n", json.dump(2));
  return 0;
}

int run(const LutArguments& arguments, const Globals& globals) {
  if (arguments.table.empty()) {
    throw Error(Fault::Usage, "expected a TABLE (see kiln list tables)");
  }
  if (!arguments.at.empty()) return print_point(arguments, globals);
  if (arguments.output.empty()) {
    throw Error(Fault::Usage,
                "no output is given: -o FILE for a table, --at MU,ROUGHNESS for one "
                "value");
  }
  Pipeline pipeline;
  pipeline.bakes.push_back(arguments.options->choice({{"table", arguments.table}}));
  return run_one_task(std::move(pipeline), arguments.output, globals);
}

Action declare(CLI::App& app) {
  const auto arguments = std::make_shared<LutArguments>();
  app.add_option("TABLE", arguments->table, "which integral (see kiln list tables)")->type_name("");
  app.add_option("-o,--output", arguments->output, "file to make: .exr .png .hdr .tif")
      ->type_name("FILE");
  app.add_option("--at", arguments->at, "print the integral there with 17 digits, make no file")
      ->type_name("MU,ROUGHNESS");
  arguments->options = std::make_unique<BakeOptions>(app, "lut", std::vector<std::string>{"table"});
  return [arguments](const Globals& globals) { return run(*arguments, globals); };
}

}  // namespace

Verb lut_verb() { return {"lut", "TABLE -o FILE", "one table of BRDF integrals", declare}; }

}  // namespace kiln
