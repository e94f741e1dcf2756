// SPDX-License-Identifier: Apache-2.0
// Sets larger than their picture needs are read halved.
#include <gtest/gtest.h>

#include "kiln/image/compare.h"
#include "kiln/math/hash.h"
#include "kiln/pipeline/run.h"
#include "support/workshop.h"

namespace kiln {
namespace {

namespace fs = std::filesystem;

using test::Workshop;

void paint_noise(const Workshop& shop, const std::string& name,
                 const std::vector<std::string>& names) {
  Layers image = make_layers({256, 256}, names);
  uint32_t seed = static_cast<uint32_t>(name.size());
  for (Layer& layer : image.layers) {
    ++seed;
    for (int y = 0; y < 256; ++y) {
      for (int x = 0; x < 256; ++x) {
        const uint32_t bits = combine_hash(seed, static_cast<uint32_t>(256 * y + x));
        layer.plane.at(x, y) = static_cast<float>(bits % 200 + 40) / 255.0f;
      }
    }
  }
  fs::create_directories(shop / "rock");
  write_image(shop / ("rock/" + name), image, {.type = PixelType::Uint8});
}

double apart(const fs::path& a, const fs::path& b) {
  const Layers left = read_image(a).image, right = read_image(b).image;
  double most = 0;
  for (const char* channel : {"R", "G", "B", "A"}) {
    for (int y = 0; y < left.size.height; ++y) {
      for (int x = 0; x < left.size.width; ++x) {
        most = std::max<double>(
            most, std::abs(left.find(channel)->at(x, y) - right.find(channel)->at(x, y)));
      }
    }
  }
  return most;
}

TEST(ReducedSets, MakeThePictureOfTheWholeSet) {
  const Workshop shop;
  shop.paint("sky.exr", 1.0f, PixelType::Float, {16, 8});
  paint_noise(shop, "x_BaseColor.png", {"R", "G", "B"});
  paint_noise(shop, "x_Roughness.png", {"Y"});
  paint_noise(shop, "x_NormalGL.png", {"R", "G", "B"});
  const std::string head =
      "version: 1\nenvironment: { sky: sky.exr }\nsets: [{ path: rock }]\nbakes:\n"
      "  - { bake: preview, env: sky, type: float, samples: 64, shape: sphere, size: 20, out: "
      "ball.exr }\n"
      "  - { bake: preview, env: sky, type: float, samples: 64, size: 30x24, out: flat.exr }\n";
  const std::string whole =
      head +
      "  - { bake: preview, env: sky, shape: contact, size: 32, mode: split-sum, out: all.exr }\n";
  const auto run = [&](const std::string& text, const char* out) {
    const Report report =
        run_plan(make_plan(read_pipeline(shop.write("p.yaml", text)), shop / out), Records::None);
    for (const TaskRecord& task : report.tasks) {
      EXPECT_FALSE(task.fault) << (task.fault ? task.fault->what() : "");
    }
  };
  run(head, "reduced");
  run(whole, "whole");
  EXPECT_LT(apart(shop / "reduced/ball.exr", shop / "whole/ball.exr"), 1e-5);
  EXPECT_LT(apart(shop / "reduced/flat.exr", shop / "whole/flat.exr"), 1e-5);
}

}  // namespace
}  // namespace kiln
