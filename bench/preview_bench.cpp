// SPDX-License-Identifier: Apache-2.0
#include <benchmark/benchmark.h>

#include "support/scenes.h"

namespace kiln {
namespace {

// A 1024 x 1024 plane whose roughness, colour and normals vary, under a sky with a small sun.
Svbrdf varied(Size size) {
  Svbrdf s = test::uniform_svbrdf({.size = size});
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const float u = static_cast<float>(x) / size.width, v = static_cast<float>(y) / size.height;
      s.roughness.at(x, y) = 0.1f + 0.8f * u;
      s.f0[0].at(x, y) = 0.04f + 0.9f * v;
      s.normal[0].at(x, y) = 0.3f * std::sin(40 * u);
      s.normal[2].at(x, y) = std::sqrt(1 - square(s.normal[0].at(x, y)));
    }
  }
  return s;
}

Layers sky() {
  const Vec3<double> sun = normalize(Vec3<double>{1, 1, 1});
  return test::make_latlong({1024, 512}, [=](const Vec3<double>& d) {
    return 0.5 + 0.3 * d.y + (dot(d, sun) > 0.9998 ? 5000 : 0);
  });
}

LightSettings prefiltered() {
  LightSettings settings;
  settings.prefiltered = true;
  return settings;
}

struct Stage {
  Svbrdf material;
  LightMade light;
  std::shared_ptr<const AlbedoTable> albedo = make_albedo_table();

  explicit Stage(Size size)
      : material(varied(size)), light(make_light(latlong_image(sky()), prefiltered())) {}

  Ingredients ingredients() const {
    Ingredients i;
    i.material = &material;
    i.light = light.light.get();
    i.albedo = albedo.get();
    return i;
  }
};

std::unique_ptr<Recipe> recipe_of(const test::Settings& settings) {
  auto recipe = make_recipe("preview");
  for (const auto& [name, value] : settings) recipe->set(name, value);
  return recipe;
}

// Reference: samples/s, a sample being one direction evaluated with environment and BRDF.
void reference(benchmark::State& state, const char* diffuse) {
  const Stage stage({1024, 1024});
  Ingredients ingredients = stage.ingredients();
  ingredients.surface.diffuse = diffuse;
  const auto recipe = recipe_of({{"samples", "64"}});
  for (auto _ : state) benchmark::DoNotOptimize(recipe->bake(ingredients));
  state.SetItemsProcessed(state.iterations() * 64 * 1024 * 1024);
}
BENCHMARK_CAPTURE(reference, lambert, "lambert")->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(reference, eon, "eon")->UseRealTime()->Unit(benchmark::kMillisecond);

// The same for models that run in stages.
void staged(benchmark::State& state, const char* distribution, const char* fresnel) {
  Stage stage({512, 512});
  Ingredients ingredients = stage.ingredients();
  ingredients.surface.distribution = distribution;
  ingredients.surface.fresnel = fresnel;
  const auto albedo = make_albedo_table(ingredients.surface);
  ingredients.albedo = albedo.get();
  const auto recipe = recipe_of({{"samples", "64"}});
  for (auto _ : state) benchmark::DoNotOptimize(recipe->bake(ingredients));
  state.SetItemsProcessed(state.iterations() * 64 * 512 * 512);
}
BENCHMARK_CAPTURE(staged, ggx_dielectric, "ggx", "dielectric")
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(staged, beckmann_conductor, "beckmann", "conductor")
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

// Glass: paths/s.
void glass(benchmark::State& state) {
  const Stage stage({512, 512});
  Ingredients ingredients = stage.ingredients();
  ingredients.surface.bsdf = "glass";
  const auto recipe = recipe_of({{"samples", "64"}, {"shape", "sphere"}, {"size", "256"}});
  for (auto _ : state) benchmark::DoNotOptimize(recipe->bake(ingredients));
  state.SetItemsProcessed(state.iterations() * 64 * 256 * 256);
}
BENCHMARK(glass)->UseRealTime()->Unit(benchmark::kMillisecond);

// Time to a mean standard error of 0.01 at 256 x 256.
void reference_to_error(benchmark::State& state) {
  const Stage stage({256, 256});
  const auto recipe = recipe_of({{"samples", "16"}, {"target_error", "0.01"}});
  double samples = 0;
  for (auto _ : state) samples = recipe->bake(stage.ingredients()).figures.at(0).second;
  state.counters["samples"] = samples;
}
BENCHMARK(reference_to_error)->UseRealTime()->Unit(benchmark::kMillisecond);

// Split-sum: texels/s.
void split_sum(benchmark::State& state) {
  const Stage stage({1024, 1024});
  const auto recipe = recipe_of({{"mode", "split-sum"}});
  for (auto _ : state) benchmark::DoNotOptimize(recipe->bake(stage.ingredients()));
  state.SetItemsProcessed(state.iterations() * 1024 * 1024);
}
BENCHMARK(split_sum)->UseRealTime()->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace kiln
