// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <cstdint>
#include <random>

#include "kiln/io/number_arrays.h"
#include "support/real_data.h"
#include "texture_pattern.h"

// Small valid files, cut short and with bytes changed: every reader returns or throws an Error. The
// sanitizers of the dev preset see what else it does.
namespace kiln {
namespace {

using namespace test;

constexpr ReadLimits limits{.max_texels = 1 << 16, .max_channels = 16};

class Fuzz : public ImageFolder {
 protected:
  // One attempt. What is returned keeps the limits.
  void read(const std::string& name, const std::string& bytes) const {
    fs::remove(folder / name);  // a new file is made faster than an old one is emptied
    const fs::path path = write_bytes(name, bytes);
    try {
      for (const NumberArray& array : read_arrays(path, limits)) {
        size_t count = 1;
        for (const int length : array.shape) count *= static_cast<size_t>(length);
        ASSERT_EQ(count, array.values.size()) << name;
      }
      ++read_;
      if (!is_text(path)) read_image(path, limits);
    } catch (const Error& error) {
      ++refused_;
      EXPECT_EQ(std::string(error.what()).rfind(path.string(), 0), 0u) << error.what();
    }
  }

  // The same as a texture. Levels and faces that are returned have the channels that are told.
  void read_levels(const std::string& name, const std::string& bytes) const {
    fs::remove(folder / name);
    const fs::path path = write_bytes(name, bytes);
    try {
      const TextureFile file = read_texture(path, limits);
      long long texels = 0;
      for (const std::vector<Layers>& level : file.texture.levels) {
        ASSERT_EQ(level.size(), file.texture.levels.front().size()) << name;
        for (const Layers& face : level) {
          texels += area(face.size);
          ASSERT_EQ(channel_names(face), file.facts.channels) << name;
        }
      }
      ASSERT_LE(texels, limits.max_texels);
      ++read_;
      read_image(path, limits);
    } catch (const Error& error) {
      ++refused_;
      EXPECT_EQ(error.fault(), Fault::Input) << error.what();
      EXPECT_EQ(std::string(error.what()).rfind(path.string(), 0), 0u) << error.what();
    }
  }

  static bool is_text(const fs::path& path) {
    return path.extension() != ".dds" && path.extension() != ".npy" && path.extension() != ".ktx" &&
           path.extension() != ".ktx2";
  }

  enum class As { Arrays, Levels };
  void attempt(const std::string& name, const std::string& bytes, As as) const {
    if (as == As::Levels) return read_levels(name, bytes);
    read(name, bytes);
  }

  void cut(const std::string& name, const std::string& bytes, As as = As::Arrays) const {
    constexpr size_t most = 200;
    const size_t step = std::max<size_t>(1, bytes.size() / most);
    for (size_t length = 1; length < bytes.size(); length += step) {
      attempt(name, bytes.substr(0, length), as);
    }
  }

  // Half of the changes fall into the first bytes, where headers are.
  void change(const std::string& name, const std::string& bytes, uint32_t seeds = 300,
              As as = As::Arrays) const {
    for (uint32_t seed = 0; seed < seeds; ++seed) {
      std::minstd_rand random(seed + 1);
      std::string changed = bytes;
      for (uint32_t n = 1 + random() % 4; n > 0; --n) {
        const size_t reach = random() % 2 == 0 ? std::min<size_t>(160, bytes.size()) : bytes.size();
        constexpr uint8_t extremes[] = {0x00, 0xff, 0x7f, 0x80, 0x01};
        const uint32_t kind = random() % 3;
        char& byte = changed[random() % reach];
        if (kind == 0) byte = static_cast<char>(extremes[random() % 5]);
        if (kind == 1) byte = static_cast<char>(random());
        if (kind == 2) byte = static_cast<char>(byte ^ 1 << random() % 8);
      }
      attempt(name, changed, as);
    }
  }

  mutable int read_ = 0;
  mutable int refused_ = 0;
};

TEST_F(Fuzz, WhatKilnWritesIsReadOrRefusedWhenDamaged) {
  for (const WritableFormat& format : writable_formats()) {
    // Damage of formats that OpenImageIO or OpenEXR decode is theirs; here are our own readers.
    if (format.name == "jpeg" || format.name == "tiff" || format.name == "png" ||
        format.name == "openexr") {
      continue;
    }
    for (const int depth : {1, 2}) {
      const fs::path path = folder / named("whole", format);
      write_image(path, pattern({5, 4}, {"R", "G"}),
                  {.type = format.types.back(), .attributes = {{"axes", "mu"}}, .depth = depth});
      const std::string bytes = bytes_of(path);
      const std::string name = named("damaged", format);
      if (depth == 1) cut(name, bytes);
      change(name, bytes, depth == 1 ? 300 : 100);
    }
  }
  EXPECT_GT(read_, 100);
  EXPECT_GT(refused_, 100);
}

TEST_F(Fuzz, ProgramsAndTablesAreReadOrRefusedWhenDamaged) {
  std::string numbers;
  for (int i = 0; i < 20; ++i) numbers += std::to_string(i * 0.25) + (i < 19 ? ", " : "");
  const std::string texts[] = {
      "/* a: b */ #define X\nstatic const float t[2][10] = {{" + numbers + "}, {0x1p-3f, .5e+1L}};",
      "const a = new Float32Array([" + numbers + "]); let b = {c: [[" + numbers + "]], d: `x`};",
      "{\"k\": [[" + numbers + "], [" + numbers + "]], \"s\": \"a\\\"b\"}",
      "E = np.array([(" + numbers + "), vec2(1, - 2), nan])  # it's\n",
      "const p = \"data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAAAAAA6fptVAAAACklE\"",
      "x,y,E\n0,0,1\n1,0,2\n0,1,3\n1,1,4e-3\n",
      "\"a \"\"b\";c\n1,5;2\n3;4,25\n",
      "1 2 3\n4 5 6 # n\n7\n"};
  for (const std::string& text : texts) {
    cut("damaged.txt", text);
    change("damaged.txt", text);
  }
  EXPECT_GT(refused_, 100);
}

TEST_F(Fuzz, DeepNestingEndsSoon) {
  const std::string deep(100000, '[');
  read("deep.js", deep);
  read("deep.h", std::string(100000, '{'));
  std::string calls;
  for (int i = 0; i < 20000; ++i) calls += "=(a(";
  read("calls.js", calls);
  EXPECT_EQ(refused_, 3);
}

TEST_F(Fuzz, DamagedTexturesAreReadOrRefused) {
  const auto word = [](uint32_t value) {
    std::string bytes;
    for (int i = 0; i < 4; ++i) bytes += static_cast<char>(value >> (8 * i) & 255);
    return bytes;
  };
  std::string legacy = "DDS ";
  for (const uint32_t value : {124u, 0x1007u, 4u, 4u, 0u, 0u, 1u}) legacy += word(value);
  legacy += std::string(44, '\0');
  for (const uint32_t value : {32u, 4u, 113u, 0u, 0u, 0u, 0u, 0u, 0x1000u, 0u, 0u, 0u, 0u}) {
    legacy += word(value);
  }
  legacy += std::string(128, '\x3c');
  std::string ktx = "\xabKTX 11\xbb\r\n\x1a\n";
  for (const uint32_t value :
       {0x04030201u, 0x1406u, 4u, 0x1903u, 0u, 0x1903u, 4u, 4u, 0u, 0u, 1u, 1u, 12u, 8u}) {
    ktx += word(value);
  }
  ktx += std::string("ab\0mu\0\0\0", 8) + word(64) + std::string(64, '\x3c');
  for (const auto& [name, bytes] : {std::pair{"a.dds", legacy}, std::pair{"a.ktx", ktx}}) {
    read_ = 0;
    read(name, bytes);
    EXPECT_EQ(read_, 1) << name;
    cut(name, bytes);
    change(name, bytes);
  }
}

TEST_F(Fuzz, DamagedLevelsAndFacesAreReadOrRefused) {
  struct Case {
    const char* name;
    PixelType type;
    Supercompression packing = Supercompression::None;
    Samples samples = Samples::Texels;
  };
  for (const Case& one :
       {Case{"a.ktx2", PixelType::Half}, Case{"b.ktx2", PixelType::Float, Supercompression::Zstd},
        Case{"a.ktx", PixelType::B10g11r11}, Case{"a.dds", PixelType::E5b9g9r9},
        Case{"a.env", PixelType::Rgbd8},
        Case{"a.exr", PixelType::Half, Supercompression::None, Samples::Nodes}}) {
    write_texture(folder / one.name, cube(4, 3),
                  {.type = one.type,
                   .supercompression = one.packing,
                   .samples = one.samples,
                   .attributes = {{"sh", "0.5 0.5 0.5"}},
                   .irradiance = IrradiancePolynomial{}});
    const std::string bytes = bytes_of(folder / one.name);
    read_ = 0;
    read_levels(one.name, bytes);
    EXPECT_EQ(read_, 1) << one.name;
    cut(one.name, bytes, As::Levels);
    change(one.name, bytes, 300, As::Levels);
    EXPECT_GT(read_, 1) << one.name;
  }
  EXPECT_GT(refused_, 1000);
}

TEST_F(Fuzz, DamagedFilesOfOthersAreReadOrRefused) {
  KILN_REQUIRE_REAL_DATA(data);
  for (const char* name :
       {"derived/venice_truncated_60pct.hdr", "oiio/dds_crash-1634.dds", "oiio/hdr_bomb-40000.hdr",
        "oiio/png-bomb_bomb.png", "openexr_tests/invalid.exr"}) {
    EXPECT_THAT(fault_text(Fault::Input, [&] { read_arrays(data / "data/damaged" / name); }),
                testing::HasSubstr(fs::path(name).filename().string()));
  }
}

}  // namespace
}  // namespace kiln
