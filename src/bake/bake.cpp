// SPDX-License-Identifier: Apache-2.0
#include "kiln/bake/bake.h"

#include "bakes.h"

namespace kiln {
namespace {

template <class Bake>
BakeFacts describe() {
  BakeFacts facts{Bake::name, Bake::summary, Bake::scope, facts_of(Bake::params()), Bake::product};
  if constexpr (requires { Bake::own_lights; }) facts.own_lights = Bake::own_lights;
  if constexpr (requires { Bake::layout; }) facts.layout = Bake::layout;
  return facts;
}

// Text to settings to product, for any bake on the list.
template <class Bake>
class RecipeOf final : public Recipe {
 public:
  const BakeFacts& facts() const override {
    static const BakeFacts facts = describe<Bake>();
    return facts;
  }
  void set(const std::string& name, const std::string& text) override {
    assign(Bake::params(), settings_, name, text);
  }
  Needs needs() const override { return Bake::needs(settings_); }
  void check(const SurfaceChoice& surface) const override {
    if constexpr (requires { Bake::check(settings_, surface); }) Bake::check(settings_, surface);
  }
  Baked bake(const Ingredients& ingredients) const override {
    return Bake::bake(settings_, ingredients);
  }

 private:
  typename Bake::Settings settings_;
};

template <class... Bake>
struct BakeList {
  static std::vector<BakeFacts> facts() { return {describe<Bake>()...}; }
  static std::unique_ptr<Recipe> make(const std::string& name) {
    std::unique_ptr<Recipe> recipe;
    ((name == Bake::name ? void(recipe = std::make_unique<RecipeOf<Bake>>()) : void()), ...);
    return recipe;
  }
};

// THE list: help, parsing, docs, the pipeline's schema and the contract tests follow from it.
using Bakes = BakeList<LutBake, EnvironmentBake, PreviewBake, DeriveBake, ConvertBake, PackBake,
                       UnpackBake, NormalBake, MipsBake, OcclusionBake>;

}  // namespace

const std::vector<BakeFacts>& all_bakes() {
  static const std::vector<BakeFacts> facts = Bakes::facts();
  return facts;
}

std::unique_ptr<Recipe> make_recipe(const std::string& bake) {
  if (auto recipe = Bakes::make(kebab(bake))) return recipe;
  std::vector<std::string> names;
  for (const BakeFacts& facts : all_bakes()) names.push_back(facts.name);
  throw Error(Fault::Usage, unknown_name("bake", bake, names));
}

}  // namespace kiln
