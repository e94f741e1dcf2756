// SPDX-License-Identifier: Apache-2.0
#include "environment_options.h"

#include "kiln/core/param.h"

namespace kiln {

void EnvironmentOptions::declare(CLI::App& app, const std::string& with_rotate) {
  app.add_option("--color-space", color_space, "colour space of the environment, if not by type")
      ->type_name("NAME");
  app.add_option("--fix", fix, "what becomes of NaN and infinite texels: none, zero, neighbors")
      ->type_name("WORD");
  if (with_rotate.empty()) return;
  app.add_option(with_rotate, rotate, "turns the environment, positive +Z toward +X [degree]")
      ->type_name("X");
}

EnvironmentChoice EnvironmentOptions::choice() const {
  EnvironmentChoice environment;
  environment.name = "env";
  environment.path = path;
  environment.color_space = color_space;
  ParamFacts facts;
  facts.name = "rotate";
  if (!rotate.empty()) environment.rotate = parse_number(facts, rotate);
  facts.name = "fix";
  facts.choices = {"none", "zero", "neighbors"};
  if (!fix.empty()) environment.fix = facts.choices[parse_word(facts, fix)];
  return environment;
}

}  // namespace kiln
