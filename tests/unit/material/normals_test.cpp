// SPDX-License-Identifier: Apache-2.0
#include "kiln/material/normals.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "kiln/core/error.h"

namespace kiln {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();

Layers one_texel(const std::vector<float>& stored) {
  const std::vector<std::string> names = {"R", "G", "B", "A"};
  Layers image{{1, 1}, {}};
  for (size_t i = 0; i < stored.size(); ++i) image.add(names[i], stored[i]);
  return image;
}

std::array<float, 3> only(const DecodedNormals& decoded) {
  return {decoded.normal[0].at(0, 0), decoded.normal[1].at(0, 0), decoded.normal[2].at(0, 0)};
}

std::array<float, 3> decode_one(const std::vector<float>& stored, const NormalDecoding& how = {}) {
  return only(decode_normals(one_texel(stored), how));
}

// A bumpy height field, and its normals in the OpenGL convention.
float bump(int x, int y) {
  return 2.0f * std::sin(0.31f * static_cast<float>(x)) +
         3.0f * std::cos(0.17f * static_cast<float>(y) + 0.11f * static_cast<float>(x));
}

Plane bumps(Size size, float sign) {
  Plane height(size);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) height.at(x, y) = 0.5f + sign * 0.1f * bump(x, y);
  }
  return height;
}

std::array<Plane, 3> normals_of_bumps(Size size) {
  std::array<Plane, 3> n = {Plane(size), Plane(size), Plane(size)};
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const float dx = 0.5f * (bump(x + 1, y) - bump(x - 1, y));
      const float dy_up = -0.5f * (bump(x, y + 1) - bump(x, y - 1));
      const float inverse = 1 / std::sqrt(dx * dx + dy_up * dy_up + 1);
      n[0].at(x, y) = -dx * inverse;
      n[1].at(x, y) = -dy_up * inverse;
      n[2].at(x, y) = inverse;
    }
  }
  return n;
}

TEST(NormalDecoding, MakesBothMiddleCodesOfEightBitsFlat) {
  for (const float code : {127.0f, 128.0f}) {
    const auto n = decode_one({code / 255, code / 255, 1});
    EXPECT_EQ(n[0], 0);
    EXPECT_EQ(n[1], 0);
    EXPECT_EQ(n[2], 1);
  }
}

TEST(NormalDecoding, LeavesEveryOtherCodeWhereItsFormulaPutsIt) {
  const auto n = decode_one({129.0f / 255, 126.0f / 255, 1});
  EXPECT_NEAR(n[0], 3.0f / 255, 1e-5);
  EXPECT_NEAR(n[1], -3.0f / 255, 1e-5);
}

TEST(NormalDecoding, TakesTheZeroItIsTold) {
  EXPECT_NEAR(decode_one({128.0f / 255, 0.5f, 1}, {.zero = NormalZero::Exact})[0], 1.0f / 255,
              1e-6);
  EXPECT_NEAR(decode_one({128.0f / 255, 0.5f, 1}, {.zero = NormalZero::Code128})[0], 0, 1e-7);
  EXPECT_NEAR(decode_one({128.0f / 255, 0.5f, 1}, {.zero = NormalZero::Code127})[0], 2.0f / 255,
              1e-5);
}

TEST(NormalDecoding, MakesVectorsUnit) {
  const auto n = decode_one({0.7f, 0.4f, 0.8f});
  EXPECT_NEAR(n[0] * n[0] + n[1] * n[1] + n[2] * n[2], 1, 1e-6);
  EXPECT_NEAR(n[0] / n[2], 0.4 / 0.6, 1e-5);
}

TEST(NormalDecoding, FlipsGreenOfDirectXMaps) {
  const auto gl = decode_one({0.6f, 0.8f, 0.9f});
  const auto dx = decode_one({0.6f, 0.8f, 0.9f}, {.convention = NormalConvention::DirectX});
  EXPECT_EQ(dx[0], gl[0]);
  EXPECT_EQ(dx[1], -gl[1]);
  EXPECT_EQ(dx[2], gl[2]);
}

TEST(NormalDecoding, RebuildsZWhereBlueIsMissingOrConstant) {
  Layers two = make_layers({2, 1}, {"R", "G"});
  two.layers[0].plane.at(0, 0) = 0.8f;
  two.layers[1].plane.at(0, 0) = 0.5f;
  two.layers[0].plane.at(1, 0) = two.layers[1].plane.at(1, 0) = 0.5f;
  Layers three = two;
  three.add("B", 1.0f);
  for (const Layers& image : {two, three}) {
    const DecodedNormals decoded = decode_normals(image, {});
    EXPECT_TRUE(decoded.two_channel);
    EXPECT_NEAR(decoded.normal[0].at(0, 0), 0.6f, 1e-6);
    EXPECT_NEAR(decoded.normal[2].at(0, 0), 0.8f, 1e-6);
    EXPECT_EQ(decoded.normal[2].at(1, 0), 1.0f);
  }
}

TEST(NormalDecoding, ReplacesVectorsWithoutDirectionAndCountsThem) {
  const DecodedNormals decoded = decode_normals(one_texel({0.503f, 0.5f, 0.502f}), {});
  EXPECT_EQ(decoded.degenerate, 1);
  EXPECT_EQ(only(decoded), (std::array<float, 3>{0, 0, 1}));
}

// Length is off by at most that of the error of the components, half a code in z and, with the
// other middle code, a whole one in x and y.
TEST(NormalDecoding, FindsEveryUnitVectorUnitThatEightBitsHold) {
  constexpr int steps = 60;
  Layers stored = make_layers({4 * steps, steps}, {"R", "G", "B"});
  for (const float half : {127.0f, 127.5f, 128.0f}) {
    for (int i = 0; i < steps; ++i) {
      for (int j = 0; j < 4 * steps; ++j) {
        const double theta = 1.5 * i / steps, phi = 6.28 * j / (4 * steps);
        const std::array<double, 3> n{std::sin(theta) * std::cos(phi),
                                      std::sin(theta) * std::sin(phi), std::cos(theta)};
        for (size_t c = 0; c < 3; ++c) {
          const double code = std::round((c < 2 ? half : 127.5) + 127.5 * n[c]);
          stored.layers[c].plane.at(j, i) =
              static_cast<float>(std::min(std::max(code, 0.0), 255.0) / 255);
        }
      }
    }
    EXPECT_EQ(decode_normals(stored, {}).not_unit, 0) << half;
  }
}

TEST(NormalDecoding, CountsLengthsThatRoundingDoesNotExplain) {
  const auto count = [](float length, NormalDecoding how = {}) {
    const float x = 0.6f * length, z = 0.8f * length;
    return decode_normals(one_texel({0.5f + 0.5f * x, 0.5f, 0.5f + 0.5f * z}), how).not_unit;
  };
  EXPECT_EQ(count(1.0f), 0);
  EXPECT_EQ(count(0.99f), 0);
  EXPECT_EQ(count(0.98f), 1);
  EXPECT_EQ(count(1.02f), 1);
  EXPECT_EQ(count(0.03f), 0);  // without direction
  EXPECT_EQ(count(nan), 0);
  EXPECT_EQ(count(1.0f, {.strength = 3}), 0);  // what is stored counts, not what is made of it
}

TEST(NormalDecoding, CountsSlopesOfTwoChannelsThatNoUnitVectorHas) {
  EXPECT_EQ(decode_normals(one_texel({0.8f, 0.5f}), {}).not_unit, 0);
  EXPECT_EQ(decode_normals(one_texel({0.95f, 0.95f}), {}).not_unit, 1);
}

TEST(NormalDecoding, RaisesVectorsBelowTheSurfaceAndCountsThem) {
  const DecodedNormals decoded = decode_normals(one_texel({0.9f, 0.5f, 0.2f}), {});
  EXPECT_EQ(decoded.below_surface, 1);
  EXPECT_GT(decoded.normal[2].at(0, 0), 0);
  EXPECT_NEAR(decoded.normal[0].at(0, 0), 1, 0.01);
}

TEST(NormalDecoding, MakesUnreadableTexelsFlatAndCountsThem) {
  for (const auto& stored : {std::vector<float>{nan, 0.5f, 1}, {0.5f, nan, 1}, {nan, 0.5f}}) {
    const DecodedNormals decoded = decode_normals(one_texel(stored), {});
    EXPECT_EQ(decoded.unreadable, 1);
    EXPECT_EQ(only(decoded), (std::array<float, 3>{0, 0, 1}));
  }
}

TEST(NormalDecoding, SeesMapsThatStoreTheComponentsThemselves) {
  const DecodedNormals decoded = decode_normals(one_texel({-0.6f, 0.0f, 0.8f}), {});
  EXPECT_TRUE(decoded.signed_range);
  EXPECT_NEAR(decoded.normal[0].at(0, 0), -0.6f, 1e-6);
}

TEST(NormalDecoding, RefusesOneChannel) {
  EXPECT_THROW(decode_normals(one_texel({0.5f}), {}), Error);
}

TEST(ConventionGuess, SeesOpenGlAndDirectXByTheHeightMap) {
  auto normal = normals_of_bumps({64, 48});
  const Plane height = bumps({64, 48}, 1);
  const ConventionGuess gl = guess_convention(normal, height);
  EXPECT_EQ(gl.convention, NormalConvention::OpenGl);
  EXPECT_LT(gl.correlation_x, -0.9);
  EXPECT_GT(gl.correlation_y, 0.9);
  flip_y(normal);
  const ConventionGuess dx = guess_convention(normal, height);
  EXPECT_EQ(dx.convention, NormalConvention::DirectX);
  EXPECT_LT(dx.correlation_y, -0.9);
}

TEST(ConventionGuess, IsNotMisledByAMapOfDepth) {
  auto normal = normals_of_bumps({64, 48});
  const Plane depth = bumps({64, 48}, -1);
  EXPECT_EQ(guess_convention(normal, depth).convention, NormalConvention::OpenGl);
  flip_y(normal);
  EXPECT_EQ(guess_convention(normal, depth).convention, NormalConvention::DirectX);
}

TEST(ConventionGuess, TakesAHeightMapOfAnotherSize) {
  const auto normal = normals_of_bumps({64, 48});
  EXPECT_EQ(guess_convention(normal, bumps({64, 48}, 1)).convention,
            guess_convention(normal, bumps({64, 48}, 1)).convention);
  const Plane flat({16, 12}, 0.5f);
  EXPECT_EQ(guess_convention(normal, flat).convention, NormalConvention::Auto);
}

TEST(ConventionGuess, IsUndecidedWhereNothingCorrelates) {
  const std::array<Plane, 3> flat = {Plane({32, 32}, 0.0f), Plane({32, 32}, 0.0f),
                                     Plane({32, 32}, 1.0f)};
  EXPECT_EQ(guess_convention(flat, bumps({32, 32}, 1)).convention, NormalConvention::Auto);
  EXPECT_EQ(guess_convention(flat).convention, NormalConvention::Auto);
}

TEST(ConventionGuess, SeesByTheNormalsAloneWhichSignMakesThemAHeightField) {
  auto normal = normals_of_bumps({64, 48});
  EXPECT_EQ(guess_convention(normal).convention, NormalConvention::OpenGl);
  flip_y(normal);
  EXPECT_EQ(guess_convention(normal).convention, NormalConvention::DirectX);
}

}  // namespace
}  // namespace kiln
