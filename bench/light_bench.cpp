// SPDX-License-Identifier: Apache-2.0
#include <benchmark/benchmark.h>

#include "kiln/image/projection.h"
#include "kiln/light/environment.h"
#include "kiln/light/irradiance.h"
#include "kiln/light/specular_chain.h"

namespace kiln {
namespace {

// A sky with a small sun.
Layers sky(Size size) {
  Layers image = make_layers(size, {"R", "G", "B"});
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const Vec3<double> d =
          latlong_to_direction(Vec2<double>{(x + 0.5) / size.width, (y + 0.5) / size.height});
      const double sun = dot(d, normalize(Vec3<double>{1, 1, 1})) > 0.9998 ? 5000 : 0;
      for (Layer& layer : image.layers) {
        layer.plane.at(x, y) = static_cast<float>(0.5 + 0.3 * d.y + sun);
      }
    }
  }
  return image;
}

void specular_chain(benchmark::State& state) {
  const int height = static_cast<int>(state.range(0));
  const Layers image = sky({2 * height, height});
  for (auto _ : state) benchmark::DoNotOptimize(SpecularChain(image, ChainOptions{}));
}
BENCHMARK(specular_chain)->Arg(256)->Arg(512)->UseRealTime()->Unit(benchmark::kMillisecond);

void irradiance_map(benchmark::State& state) {
  const Layers image = sky({1024, 512});
  for (auto _ : state) benchmark::DoNotOptimize(IrradianceMap(image));
}
BENCHMARK(irradiance_map)->UseRealTime()->Unit(benchmark::kMillisecond);

void sampling_tables(benchmark::State& state) {
  const Layers image = sky({1024, 512});
  for (auto _ : state) benchmark::DoNotOptimize(Environment(image));
}
BENCHMARK(sampling_tables)->UseRealTime()->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace kiln
