// SPDX-License-Identifier: Apache-2.0
#include "kiln/material/anisotropy.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "kiln/core/error.h"
#include "kiln/material/workflow.h"

namespace kiln {
namespace {

using testing::HasSubstr;

constexpr float pi = std::numbers::pi_v<float>;

SlotMap constant(float v) {
  SlotMap map;
  map.value = {v, v, v};
  return map;
}

SlotMap image(Size size, const std::vector<float>& values) {
  const std::vector<std::string> names = {"R", "G", "B", "A"};
  SlotMap map;
  map.image.size = size;
  for (size_t i = 0; i < values.size(); ++i) map.image.add(names[i], values[i]);
  return map;
}

Svbrdf resolved(const SlotMaps& maps) { return resolve(maps, {}).svbrdf; }

TEST(LobeShapes, KeepTheProductOfTheWidthsAtAlphaSquared) {
  for (const float roughness : {0.1f, 0.5f, 1.0f}) {
    for (const float anisotropy : {0.0f, 0.3f, 1.0f, most_anisotropic}) {
      const LobeWidths alpha = anisotropic_widths({roughness, anisotropy});
      EXPECT_NEAR(alpha.x * alpha.y, std::pow(roughness, 4), 1e-6);
      EXPECT_GE(alpha.x, alpha.y);
    }
  }
  const LobeWidths strongest = anisotropic_widths({0.5f, most_anisotropic});
  EXPECT_NEAR(strongest.y / strongest.x, 0.01f, 1e-4);
}

TEST(LobeShapes, AreFoundBackFromTheirWidths) {
  for (const float roughness : {0.05f, 0.4f, 0.9f}) {
    for (const float anisotropy : {0.0f, 0.2f, 0.9f}) {
      const LobeShape shape = lobe_shape(anisotropic_widths({roughness, anisotropy}));
      EXPECT_NEAR(shape.roughness, roughness, 1e-5);
      EXPECT_NEAR(shape.anisotropy, anisotropy, 1e-4);
    }
  }
}

TEST(LobeShapes, HaveTheWidthsOfTheModelTheyWereStatedIn) {
  const float r = 0.5f, alpha = r * r, s = 0.6f;
  const LobeWidths gltf = anisotropic_widths(lobe_shape(AnisotropyEncoding::Gltf, r, s));
  EXPECT_NEAR(gltf.x, alpha + (1 - alpha) * s * s, 1e-5);
  EXPECT_NEAR(gltf.y, alpha, 1e-5);
  const LobeWidths openpbr = anisotropic_widths(lobe_shape(AnisotropyEncoding::OpenPbr, r, s));
  EXPECT_NEAR(openpbr.x * openpbr.x + openpbr.y * openpbr.y, 2 * alpha * alpha, 1e-5);
  EXPECT_NEAR(openpbr.y / openpbr.x, 1 - s, 1e-5);
}

TEST(Anisotropy, IsNoPlaneWhereItIsNotGiven) {
  const Svbrdf svbrdf = resolved(
      {{Slot::Roughness, image({4, 4}, {0.5f})}, {Slot::AnisotropyAngle, constant(0.25f)}});
  EXPECT_TRUE(svbrdf.anisotropy.empty());
  EXPECT_TRUE(svbrdf.anisotropy_angle.empty());
  EXPECT_TRUE(halve(svbrdf).anisotropy.empty());
}

TEST(Anisotropy, TakesItsAngleInTurnsDegreesRadiansOrAsADirection) {
  const auto angle_of = [](SlotMap map, AngleEncoding encoding) {
    map.decoding.angle = encoding;
    return resolved({{Slot::Anisotropy, constant(0.5f)}, {Slot::AnisotropyAngle, std::move(map)}})
        .anisotropy_angle.at(0, 0);
  };
  EXPECT_NEAR(angle_of(constant(0.125f), AngleEncoding::Turns), pi / 4, 1e-6);
  EXPECT_NEAR(angle_of(constant(45), AngleEncoding::Degrees), pi / 4, 1e-6);
  EXPECT_NEAR(angle_of(constant(0.3f), AngleEncoding::Radians), 0.3f, 1e-6);
  EXPECT_NEAR(angle_of(image({2, 2}, {0.9f, 0.9f}), AngleEncoding::Direction), pi / 4, 1e-6);
  SlotMap turned = image({2, 2}, {1.0f, 0.5f});
  turned.decoding.offset = {0.2f, 0.2f, 0.2f};
  EXPECT_NEAR(angle_of(turned, AngleEncoding::Direction), 0.2f, 1e-6);
  EXPECT_THROW(angle_of(image({2, 2}, {0.5f}), AngleEncoding::Direction), Error);
}

TEST(Anisotropy, TurnsTheOtherWayBesideDirectXNormals) {
  SlotMap normal = image({2, 2}, {0.5f, 0.7f, 0.9f});
  normal.convention = NormalConvention::DirectX;
  const Svbrdf svbrdf = resolved({{Slot::Anisotropy, constant(0.5f)},
                                  {Slot::AnisotropyAngle, image({2, 2}, {0.125f})},
                                  {Slot::Normal, normal}});
  EXPECT_NEAR(svbrdf.anisotropy_angle.at(1, 1), -pi / 4, 1e-6);
}

TEST(Anisotropy, IsResampledAsAnAxisThatIsTheSameAfterHalfATurn) {
  SlotMap angle = image({2, 2}, {0});
  for (int y = 0; y < 2; ++y) {
    angle.image.layers[0].plane.at(0, y) = 0.49f;  // of a turn: -3.6 degrees
    angle.image.layers[0].plane.at(1, y) = 0.01f;
  }
  const Svbrdf svbrdf = resolved({{Slot::Roughness, image({8, 8}, {0.5f})},
                                  {Slot::Anisotropy, constant(0.5f)},
                                  {Slot::AnisotropyAngle, angle}});
  EXPECT_EQ(svbrdf.anisotropy_angle.size(), (Size{8, 8}));
  for (int x = 0; x < 8; ++x) EXPECT_LT(std::abs(svbrdf.anisotropy_angle.at(x, 3)), 0.07f) << x;
}

TEST(Anisotropy, TakesTheRoughnessAlongWhereItsModelWidensTheLobe) {
  SlotMap strength = constant(0.6f);
  strength.decoding.anisotropy = AnisotropyEncoding::Gltf;
  const Svbrdf svbrdf = resolved({{Slot::Roughness, constant(0.5f)}, {Slot::Anisotropy, strength}});
  const LobeWidths alpha =
      anisotropic_widths({svbrdf.roughness.at(0, 0), svbrdf.anisotropy.at(0, 0)});
  EXPECT_NEAR(alpha.x, 0.25f + 0.75f * 0.36f, 1e-5);
  EXPECT_NEAR(alpha.y, 0.25f, 1e-5);
}

TEST(Anisotropy, IsHalvedAsTheCovarianceOfSlopes) {
  Svbrdf svbrdf = resolved({{Slot::Roughness, image({2, 2}, {0.6f})},
                            {Slot::Anisotropy, constant(0.8f)},
                            {Slot::AnisotropyAngle, image({2, 2}, {0.05f})}});
  const Svbrdf same = halve(svbrdf);
  EXPECT_NEAR(same.roughness.at(0, 0), 0.6f, 1e-5);
  EXPECT_NEAR(same.anisotropy.at(0, 0), 0.8f, 1e-4);
  EXPECT_NEAR(same.anisotropy_angle.at(0, 0), 0.1f * pi, 1e-5);
  for (int i = 0; i < 2; ++i) {
    svbrdf.anisotropy_angle.at(i, 0) = 0;
    svbrdf.anisotropy_angle.at(i, 1) = pi / 2;
  }
  const Svbrdf crossed = halve(svbrdf);
  const LobeWidths alpha = anisotropic_widths({0.6f, 0.8f});
  const float mean = (alpha.x * alpha.x + alpha.y * alpha.y) / 2;
  EXPECT_NEAR(crossed.anisotropy.at(0, 0), 0, 1e-4);
  EXPECT_NEAR(crossed.roughness.at(0, 0), std::pow(mean, 0.25f), 1e-5);
}

TEST(SlotDecoding, ReadsAlphaAsTheSquareOfRoughness) {
  SlotMap alpha = image({2, 2}, {0.25f});
  alpha.decoding.roughness = RoughnessEncoding::Alpha;
  EXPECT_NEAR(resolved({{Slot::Roughness, alpha}}).roughness.at(1, 1), 0.5f, 1e-6);
}

TEST(SlotDecoding, ScalesAndOffsetsColoursAndNumbers) {
  SlotMap color = image({2, 2}, {0.5f});
  color.decoding.scale = {1, 0.5f, 0};
  SlotMap occlusion = image({2, 2}, {0.5f});
  occlusion.decoding = {.scale = {0.4f, 0.4f, 0.4f}, .offset = {0.6f, 0.6f, 0.6f}};
  const Svbrdf svbrdf = resolved({{Slot::BaseColor, color}, {Slot::AmbientOcclusion, occlusion}});
  EXPECT_NEAR(svbrdf.diffuse_color[0].at(0, 0), 0.5f, 1e-6);
  EXPECT_NEAR(svbrdf.diffuse_color[1].at(0, 0), 0.25f, 1e-6);
  EXPECT_NEAR(svbrdf.diffuse_color[2].at(0, 0), 0, 1e-6);
  EXPECT_NEAR(svbrdf.ambient_occlusion.at(0, 0), 0.8f, 1e-6);
}

TEST(SlotDecoding, ScalesTheSlopesOfNormals) {
  SlotMap normal = image({2, 2}, {0.8f, 0.5f, 0.9f});
  normal.convention = NormalConvention::OpenGl;
  normal.decoding.scale = {0.5f, 0.5f, 1};
  const Svbrdf svbrdf = resolved({{Slot::Normal, normal}});
  EXPECT_NEAR(svbrdf.normal[0].at(0, 0) / svbrdf.normal[2].at(0, 0), 0.3f / 0.8f, 1e-5);
}

TEST(Dielectrics, AreTintedUpToOneAndThenWeighed) {
  SlotMap tint;
  tint.value = {0.5f, 1, 100};
  const SlotMaps maps = {{Slot::BaseColor, constant(0.8f)},
                         {Slot::SpecularTint, tint},
                         {Slot::SpecularWeight, constant(0.5f)}};
  SlotMaps bright = maps;
  bright[Slot::SpecularLevel] = constant(1);
  bright[Slot::SpecularLevel].encoding = SpecularEncoding::F0;
  EXPECT_NEAR(resolved(maps).f0[0].at(0, 0), 0.01f, 1e-6);
  EXPECT_NEAR(resolved(maps).f0[1].at(0, 0), 0.02f, 1e-6);
  EXPECT_NEAR(resolved(bright).f0[2].at(0, 0), 0.5f, 1e-6);
}

}  // namespace
}  // namespace kiln
