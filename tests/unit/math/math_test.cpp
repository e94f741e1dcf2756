// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cstdint>
#include <set>

#include "kiln/math/frame.h"
#include "kiln/math/hash.h"

namespace kiln {
namespace {

TEST(Frames, AreOrthonormalAndRightHandedAroundEveryNormal) {
  for (int i = 0; i < 400; ++i) {
    const double z = -1 + (i + 0.5) / 200, phi = 2.4 * i, r = std::sqrt(1 - z * z);
    const Frame<double> frame = frame_around(Vec3<double>{r * cos(phi), r * sin(phi), z});
    EXPECT_NEAR(dot(frame.x, frame.y), 0, 1e-14);
    EXPECT_NEAR(dot(frame.x, frame.z), 0, 1e-14);
    EXPECT_NEAR(length(frame.x), 1, 1e-14);
    EXPECT_NEAR(dot(cross(frame.x, frame.y), frame.z), 1, 1e-14);
  }
}

TEST(Frames, UndoThemselves) {
  const Frame<double> frame = frame_around(normalize(Vec3<double>{1, -2, -3}));
  const Vec3<double> v{0.3, 0.4, -0.5};
  const Vec3<double> back = frame.to_world(frame.to_local(v));
  EXPECT_NEAR(length(back - v), 0, 1e-15);
}

TEST(WideNumbers, AgreeWithTheirScalarsLaneForLane) {
  float in[lane_count<WideFloat>], out[lane_count<WideFloat>];
  for (int i = 0; i < lane_count<WideFloat>; ++i) in[i] = 0.1f + 0.37f * static_cast<float>(i);
  store_lanes(out, lerp(sqrt(load_lanes<WideFloat>(in)), WideFloat(2), WideFloat(0.25f)));
  for (int i = 0; i < lane_count<WideFloat>; ++i) {
    EXPECT_EQ(out[i], lerp(sqrt(in[i]), 2.0f, 0.25f));
  }
}

TEST(WideNumbers, GatherEachLaneFromItsOwnIndex) {
  std::vector<float> table(64);
  for (size_t i = 0; i < table.size(); ++i) table[i] = static_cast<float>(i * i);
  std::int32_t index[lane_count<WideFloat>];
  float out[lane_count<WideFloat>];
  for (int i = 0; i < lane_count<WideFloat>; ++i) index[i] = (i * 29 + 3) % 64;
  store_lanes(out, gather(table.data(), WideInt::load_unaligned(index)));
  for (int i = 0; i < lane_count<WideFloat>; ++i) EXPECT_EQ(out[i], table[index[i]]);
}

TEST(Hashes, OfNeighboursDoNotCollide) {
  std::set<std::uint32_t> seen;
  for (std::uint32_t y = 0; y < 100; ++y) {
    for (std::uint32_t x = 0; x < 100; ++x) seen.insert(combine_hash(combine_hash(0u, y), x));
  }
  EXPECT_GE(seen.size(), 9998u);  // 10^4 draws of 2^32 expect 0.01 collisions
}

TEST(Hashes, AreTheSameWideAndScalar) {
  const WideUint wide = combine_hash<WideUint>(WideUint(17u), WideUint(42u));
  EXPECT_EQ(wide.get(3), combine_hash<std::uint32_t>(17u, 42u));
}

}  // namespace
}  // namespace kiln
