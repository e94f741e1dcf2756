// SPDX-License-Identifier: Apache-2.0
#include <memory>

#include "environment_options.h"
#include "kiln/core/error.h"
#include "one_bake.h"
#include "verb.h"

namespace kiln {
namespace {

struct EnvArguments {
  std::string output;
  EnvironmentOptions environment;
  std::unique_ptr<BakeOptions> options;
};

int run(const EnvArguments& arguments, const Globals& globals) {
  if (arguments.environment.path.empty()) throw Error(Fault::Usage, "expected an IMAGE");
  Pipeline pipeline;
  pipeline.environments.push_back(arguments.environment.choice());
  pipeline.bakes.push_back(arguments.options->choice({{"env", "env"}}));
  return run_one_bake(std::move(pipeline), arguments.output, globals);
}

Action declare(CLI::App& app) {
  const auto arguments = std::make_shared<EnvArguments>();
  app.add_option("IMAGE", arguments->environment.path,
                 "image of distant light, or the name of six with <FACE>, or their folder")
      ->type_name("");
  app.add_option("-o,--output", arguments->output, "folder for what is made")->type_name("DIR");
  arguments->environment.declare(app);
  arguments->options =
      std::make_unique<BakeOptions>(app, "environment", std::vector<std::string>{});
  return [arguments](const Globals& globals) { return run(*arguments, globals); };
}

}  // namespace

Verb env_verb() {
  return {"env", "IMAGE -o DIR", "prefiltered specular chain, irradiance and harmonics", declare};
}

}  // namespace kiln
