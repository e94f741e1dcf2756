// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>
#include <utility>

#include "environment_options.h"
#include "help.h"
#include "kiln/core/error.h"
#include "material_options.h"
#include "one_bake.h"
#include "verb.h"

namespace kiln {
namespace {

struct PreviewArguments {
  std::string output;
  MaterialOptions material;
  EnvironmentOptions environment;
  std::vector<std::string> lights;
  std::unique_ptr<BakeOptions> options;
};

int run(const PreviewArguments& arguments, const Globals& globals) {
  if (arguments.material.path.empty()) {
    throw Error(Fault::Usage,
                "expected a MATERIAL: a folder of maps, a material file or a packed image");
  }
  if (arguments.environment.path.empty() && arguments.lights.empty()) {
    throw Error(Fault::Usage,
                "no environment is given: --env IMAGE, or lights: --light dir:x,y,z:r,g,b");
  }
  Pipeline pipeline;
  std::vector<std::pair<std::string, std::string>> keys;
  if (!arguments.environment.path.empty()) {
    pipeline.environments.push_back(arguments.environment.choice());
    keys.emplace_back("env", "env");
  }
  if (!arguments.lights.empty()) {
    keys.emplace_back("lights", fmt::format("{}", fmt::join(arguments.lights, ";")));
  }
  pipeline.bakes.push_back(arguments.options->choice(std::move(keys)));
  arguments.material.add_to(pipeline);
  require_names_for_sets(pipeline, arguments.output);
  return run_one_bake(std::move(pipeline), arguments.output, globals);
}

Action declare(CLI::App& app) {
  const auto arguments = std::make_shared<PreviewArguments>();
  app.add_option("MATERIAL", arguments->material.path,
                 "folder of maps, a material file, or a packed image")
      ->type_name("");
  app.add_option("--env", arguments->environment.path,
                 "image to light it with, or the name of six with <FACE>, or their folder")
      ->type_name("IMAGE");
  app.add_option("-o,--output", arguments->output, "file to make: .exr .png .jpg .hdr .tif")
      ->type_name("FILE");
  app.add_option("--light", arguments->lights,
                 "dir:x,y,z:r,g,b: one from there, irradiance [W/m^2]; any number")
      ->type_name("LIGHT")
      ->allow_extra_args(false);
  arguments->options =
      std::make_unique<BakeOptions>(app, "preview", std::vector<std::string>{"lights"});
  arguments->material.declare(app);
  arguments->material.declare_models(app);
  arguments->environment.declare(app, {"rotate"}, of_the_environment);
  return [arguments](const Globals& globals) { return run(*arguments, globals); };
}

}  // namespace

Verb preview_verb() {
  return {"preview", "MATERIAL --env IMAGE -o FILE", "lit picture of a texture set", declare};
}

}  // namespace kiln
