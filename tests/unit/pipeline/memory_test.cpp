// SPDX-License-Identifier: Apache-2.0
// What a dry run says of memory. That it bounds what is used is measured, not tested.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "kiln/io/image_rows.h"
#include "kiln/parallel/threads.h"
#include "kiln/pipeline/plan.h"
#include "support/workshop.h"

namespace kiln {
namespace {

using test::Workshop;

long long predicted(const Workshop& shop, const std::string& maps, const std::string& bake) {
  const std::string text = "version: 1\nsets: [{ name: s, maps: { " + maps + " } }]\nbakes: [{ " +
                           bake + ", out: o }]\n";
  const Plan plan = make_plan(read_pipeline(shop.write("p.yaml", text)), shop / "out");
  return predicted_memory(plan, plan.tasks.at(0)).value_or(-1);
}

constexpr Size size{512, 1024};
constexpr long long plane = 4LL * size.width * size.height;

TEST(PredictedMemory, CountsThePlanesOfAnisotropy) {
  const Workshop shop;
  shop.paint("a.png", 0.5f, PixelType::Uint8, size);
  const std::string derive = "bake: derive, quantities: f0";
  const long long isotropic = predicted(shop, "roughness: a.png", derive);
  const long long anisotropic =
      predicted(shop, "roughness: a.png, anisotropy: { value: 0.5 }", derive);
  // One more in each band of 64 rows that is being computed, and what the allocator keeps of it.
  const int bands = std::min(6, available_threads());
  EXPECT_NEAR(static_cast<double>(anisotropic - isotropic), 1.6 * bands * 64 * 4 * size.width, 1);
}

TEST(PredictedMemory, CountsThePlanesThatAreMade) {
  const Workshop shop;
  shop.paint("a.png", 0.5f, PixelType::Uint8, size);
  const long long one = predicted(shop, "roughness: a.png", "bake: derive, quantities: alpha");
  const long long four =
      predicted(shop, "roughness: a.png", "bake: derive, quantities: \"alpha,f0\"");
  // Three more in each of the six bands of 64 rows on their way.
  EXPECT_GE(four - one, 3LL * 6 * 64 * 4 * size.width);
}

TEST(PredictedMemory, CountsMapsThatAreHeldWhole) {
  const Workshop shop;
  shop.paint("a.png", 0.5f, PixelType::Uint8, size);
  const std::string maps = "base_color: a.png, normal: a.png, height: a.png, opacity: a.png";
  const auto more = [&](const std::string& bake, const std::string& held) {
    return predicted(shop, maps, bake + held) - predicted(shop, maps, bake);
  };
  EXPECT_EQ(more("bake: mips", ", alpha_test: 0.5"), plane * 5 / 4);
  EXPECT_EQ(more("bake: normal", ", from: height"), plane);
  EXPECT_GE(predicted(shop, maps, "bake: occlusion") - predicted(shop, maps, "bake: normal"),
            2 * plane);
}

TEST(PredictedMemory, CountsFilesThatAreNotReadRowByRow) {
  const Workshop shop;
  shop.paint("a.png", 0.5f, PixelType::Uint8, size);
  shop.paint("a.hdr", 0.5f, PixelType::Float, size);
  const std::string unpack = "bake: unpack";
  const auto besides_its_bytes = [&](const std::string& file) {
    return predicted(shop, "base_color: " + file, unpack) -
           static_cast<long long>(std::filesystem::file_size(shop / file));
  };
  EXPECT_EQ(besides_its_bytes("a.hdr"), besides_its_bytes("a.png") + 3 * plane);
}

TEST(PredictedMemory, CountsAPartOfLargeFilesAndNothingOfOpenExr) {
  const Workshop shop;
  const auto of_size = [&](const std::string& name, size_t size) {
    FileFacts facts;
    facts.format = std::filesystem::path(name).extension() == ".exr" ? "openexr" : "png";
    shop.write(name, "");
    std::filesystem::resize_file(shop / name, size);
    return bytes_kept(shop / name, facts);
  };
  EXPECT_EQ(of_size("a.png", 1000), 1000);
  EXPECT_EQ(of_size("b.png", size_t{1} << 30), 16LL << 20);
  EXPECT_EQ(of_size("a.exr", 1000), 0);
}

}  // namespace
}  // namespace kiln
