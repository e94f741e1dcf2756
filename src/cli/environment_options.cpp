// SPDX-License-Identifier: Apache-2.0
#include "environment_options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "kiln/core/names.h"
#include "kiln/pipeline/schema.h"

namespace kiln {

void EnvironmentOptions::declare(CLI::App& app, const std::vector<std::string>& except,
                                 const std::string& group) {
  const BlockFacts& block = block_named("environment");
  keys.reserve(block.keys.size());
  for (const Key& key : block.keys) {
    const ParamFacts& facts = key.facts;
    if (facts.name == "path" || std::count(except.begin(), except.end(), facts.name)) continue;
    keys.emplace_back(facts.name, "");
    std::string meaning = facts.meaning + (facts.unit.empty() ? "" : " " + facts.unit);
    if (!facts.choices.empty()) {
      meaning +=
          fmt::format(": {} (default {})", fmt::join(facts.choices, ", "), facts.default_text);
    }
    const std::string type = facts.kind == ParamFacts::Kind::Word     ? "WORD"
                             : facts.kind == ParamFacts::Kind::Number ? "X"
                                                                      : "NAME";
    app.add_option("--" + kebab(facts.name), keys.back().second, meaning)
        ->type_name(type)
        ->group(group);
  }
}

EnvironmentChoice EnvironmentOptions::choice() const {
  std::vector<std::pair<std::string, std::string>> given = {{"path", path}};
  std::copy_if(keys.begin(), keys.end(), std::back_inserter(given),
               [](const auto& key) { return !key.second.empty(); });
  EnvironmentChoice environment = environment_choice("env", given);
  environment.path = path;
  return environment;
}

}  // namespace kiln
