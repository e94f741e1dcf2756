// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <memory>

#include "environment_options.h"
#include "help.h"
#include "kiln/core/error.h"
#include "material_options.h"
#include "one_bake.h"
#include "verb.h"

namespace kiln {
namespace {

struct BakeArguments {
  std::string output;
  MaterialOptions material;
  EnvironmentOptions environment;
  std::unique_ptr<BakeOptions> options;
};

int run(const BakeArguments& arguments, const Globals& globals) {
  if (arguments.material.path.empty()) {
    throw Error(Fault::Usage,
                "expected a MATERIAL: a folder of maps, a material file or a packed image");
  }
  Pipeline pipeline;
  std::vector<std::pair<std::string, std::string>> keys;
  if (!arguments.environment.path.empty()) {
    pipeline.environments.push_back(arguments.environment.choice());
    keys.emplace_back("env", "env");
  }
  pipeline.bakes.push_back(arguments.options->choice(std::move(keys)));
  arguments.material.add_to(pipeline);
  require_names_for_sets(pipeline, arguments.output);
  return run_one_bake(std::move(pipeline), arguments.output, globals);
}

std::string output_text(Product product) {
  return product == Product::Maps ? "folder to make, or a name with {suffix} in it"
                                  : "file to make";
}

Action declare(CLI::App& app, const BakeFacts& facts) {
  const auto arguments = std::make_shared<BakeArguments>();
  const Needs needs = make_recipe(facts.name)->needs();
  app.add_option("MATERIAL", arguments->material.path,
                 "folder of maps, a material file, or a packed image")
      ->type_name("");
  app.add_option("-o,--output", arguments->output, output_text(facts.product))->type_name("PATH");
  arguments->options = std::make_unique<BakeOptions>(app, facts.name, std::vector<std::string>{});
  arguments->material.declare(app);
  if (needs.material || needs.albedo) arguments->material.declare_models(app);
  if (needs.light) {
    app.add_option("--env", arguments->environment.path, "image to light it with")
        ->type_name("IMAGE");
    arguments->environment.declare(app, {"rotate"}, of_the_environment);
  }
  return [arguments](const Globals& globals) { return run(*arguments, globals); };
}

std::vector<std::string> bakes_of_sets() {
  std::vector<std::string> names;
  for (const BakeFacts& facts : all_bakes()) {
    if (facts.scope == Scope::PerSet) names.push_back(facts.name);
  }
  return names;
}

Verb verb_of(const std::string& word) {
  const std::vector<std::string> names = bakes_of_sets();
  for (const BakeFacts& facts : all_bakes()) {
    if (facts.name != kebab(word) || facts.scope != Scope::PerSet) continue;
    return {"bake " + facts.name, "MATERIAL -o DIR", facts.summary,
            [&facts](CLI::App& app) { return declare(app, facts); }};
  }
  throw Error(Fault::Usage, unknown_name("bake", word, names));
}

Action declare_any(CLI::App& app) {
  const auto name = std::make_shared<std::string>();
  app.add_option("NAME", *name,
                 fmt::format("{}; each has its --help", fmt::join(bakes_of_sets(), ", ")))
      ->type_name("");
  return [name](const Globals&) -> int {
    throw Error(Fault::Usage,
                fmt::format("expected the NAME of a bake: {}", fmt::join(bakes_of_sets(), ", ")));
  };
}

}  // namespace

Verb bake_verb() {
  return {"bake", "NAME MATERIAL -o DIR", "any bake from the list on one texture set", declare_any,
          verb_of};
}

}  // namespace kiln
