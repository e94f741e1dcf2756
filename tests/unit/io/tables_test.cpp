// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <cstring>

#include "image_folder.h"
#include "kiln/io/number_arrays.h"

namespace kiln {
namespace {

using namespace test;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

const std::vector<std::vector<std::string>> channel_sets{
    {"E"}, {"R", "G"}, {"R", "G", "B"}, {"R", "G", "B", "A"}};

double half_step(PixelType type, size_t channel) {
  switch (type) {
    case PixelType::Uint8:
      return 0.5001 / 255;
    case PixelType::Uint16:
      return 0.5001 / 65535;
    case PixelType::Half:
      return 0.00025;
    case PixelType::Rgb10a2:
      return channel == 3 ? 0.5001 / 3 : 0.5001 / 1023;
    case PixelType::Rgbd8:
      return 2.2 * 0.5001 / 255;  // half of the step at value 1
    case PixelType::Float:
      return 5e-9;  // nine digits
    default:
      return 0;
  }
  return 0;
}

bool is_texture(const WritableFormat& format) {
  return format.name == "dds" || format.name == "ktx2";
}

// Where a header holds bits or integers, their meaning.
double meaning(double number, PixelType type) {
  if (type == PixelType::Uint8) return number / 255;
  if (type == PixelType::Uint16) return number / 65535;
  if (type != PixelType::Half) return number;
  const int bits = static_cast<int>(number);
  const int exponent = bits >> 10 & 31;
  const double mantissa = bits & 1023;
  return exponent == 0 ? std::ldexp(mantissa, -24) : std::ldexp(mantissa + 1024, exponent - 25);
}

double rgbd(const std::vector<double>& values, size_t texel, size_t channel) {
  return std::pow(values[4 * texel + channel], 2.2) / values[4 * texel + 3];
}

class Tables : public ImageFolder {
 protected:
  struct Case {
    WritableFormat format;
    PixelType type;
    std::vector<std::string> names;
    int depth;
  };
  static std::vector<Case> cases() {
    std::vector<Case> all;
    for (const WritableFormat& format : table_formats()) {
      for (const PixelType type : format.types) {
        for (const auto& names : channel_sets) {
          const bool divisor = type == PixelType::Rgbd8 && names.size() == 4;
          for (const int depth : {1, 3}) {
            if (!divisor) all.push_back({format, type, names, depth});
          }
        }
      }
    }
    return all;
  }

  // Compares every entry with the image it was written from.
  static void expect_same(const Layers& image, const Case& one, const NumberArray& array) {
    const size_t stored = static_cast<size_t>(array.shape.back());
    const bool header = one.format.name == "h";
    const size_t channels =
        one.names.size() == 1 && !is_texture(one.format) && one.format.name == "npy" ? 1 : stored;
    double worst = 0;
    size_t texel = 0;
    for (int y = 0; y < image.size.height; ++y) {
      for (int x = 0; x < image.size.width; ++x, ++texel) {
        for (size_t c = 0; c < one.names.size(); ++c) {
          const double found = one.type == PixelType::Rgbd8 ? rgbd(array.values, texel, c)
                                                            : array.values[texel * channels + c];
          const double value = header ? meaning(found, one.type) : found;
          worst = std::max(
              worst, std::abs(value - image.layers[c].plane.at(x, y)) / half_step(one.type, c));
        }
      }
    }
    EXPECT_EQ(texel * channels, array.values.size());
    EXPECT_LE(worst, 1);
  }
};

TEST_F(Tables, EveryFormatTypeAndNumberOfChannelsReadsBackInTwoAndThreeDimensions) {
  for (const Case& one : cases()) {
    const fs::path path = folder / named("x", one.format);
    SCOPED_TRACE(path.filename().string() + " " + std::string(pixel_type_name(one.type)) + " x" +
                 std::to_string(one.names.size()) + " depth " + std::to_string(one.depth));
    const Layers image = pattern({7, 5 * one.depth}, one.names);
    const WriteFacts facts = write_image(path, image, {.type = one.type, .depth = one.depth});
    EXPECT_EQ(facts.clamped, 0);
    const std::vector<NumberArray> arrays = read_arrays(path);
    ASSERT_EQ(arrays.size(), 1u);
    const std::vector<int>& shape = arrays[0].shape;
    const bool bare = one.format.name == "npy" && one.names.size() == 1;
    std::vector<int> wanted{5, 7};
    if (one.depth > 1) wanted.insert(wanted.begin(), one.depth);
    if (!bare) wanted.push_back(shape.back());
    EXPECT_EQ(shape, wanted);
    const bool filled =
        is_texture(one.format) && (one.type == PixelType::Rgb10a2 || one.type == PixelType::Rgbd8 ||
                                   (one.names.size() == 3 && one.type != PixelType::Float));
    if (!bare) {
      EXPECT_EQ(shape.back(), filled ? 4 : static_cast<int>(one.names.size()));
    }
    expect_same(image, one, arrays[0]);
  }
}

TEST_F(Tables, TexturesAndArraysAreImagesTooAndVolumesAreStacks) {
  for (const Case& one : cases()) {
    if (one.format.name == "csv" || one.format.name == "h" || one.type == PixelType::Rgbd8)
      continue;
    const fs::path path = folder / named("x", one.format);
    SCOPED_TRACE(path.filename().string() + " " + std::string(pixel_type_name(one.type)) + " x" +
                 std::to_string(one.names.size()) + " depth " + std::to_string(one.depth));
    const Layers image = pattern({7, 5 * one.depth}, one.names);
    write_image(path, image, {.type = one.type, .depth = one.depth});
    const ImageFile file = read_image(path);
    EXPECT_EQ(file.facts.format, one.format.name);
    EXPECT_EQ(file.facts.type, one.type);
    EXPECT_EQ(file.image.size, image.size);
    EXPECT_EQ(file.facts.channels, channel_names(file.image));
    EXPECT_EQ(inspect_image(path).channels, file.facts.channels);
    EXPECT_EQ(inspect_image(path).size, image.size);
    EXPECT_EQ(file.facts.notes.empty(), one.depth == 1);
    for (size_t c = 0; c < one.names.size(); ++c) {
      EXPECT_NEAR(file.image.layers[c].plane.at(6, 4), image.layers[c].plane.at(6, 4),
                  half_step(one.type, c));
    }
    if (file.image.layers.size() == 4 && one.names.size() < 4) {
      EXPECT_EQ(file.image.find("A")->at(3, 2), 1.0f);
    }
  }
}

TEST_F(Tables, AreReadBackExactlyInFloat) {
  Layers image = make_layers({3, 1}, {"E"});
  const float values[] = {0.1f, 1.0f / 3.0f, 1.17549435e-38f};
  for (int x = 0; x < 3; ++x) image.layers[0].plane.at(x, 0) = values[x];
  for (const WritableFormat& format : table_formats()) {
    const fs::path path = folder / named("a", format);
    Layers wide = make_layers({3, 6}, {"E"});
    for (int y = 0; y < 6; ++y) {
      for (int x = 0; x < 3; ++x) wide.layers[0].plane.at(x, y) = values[x];
    }
    write_image(path, wide, {.type = PixelType::Float});
    const NumberArray array = read_arrays(path).front();
    for (size_t x = 0; x < 3; ++x) {
      EXPECT_EQ(static_cast<float>(array.values[x]), values[x]) << format.name;
    }
  }
}

TEST_F(Tables, ClampAndCountWhatATypeCannotHold) {
  Layers image = make_layers({4, 4}, {"R", "G", "B"});
  image.layers[0].plane.at(0, 0) = 300.0f;
  image.layers[1].plane.at(1, 0) = -0.25f;
  image.layers[2].plane.at(2, 0) = NAN;
  for (const PixelType type : {PixelType::Uint8, PixelType::Rgb10a2, PixelType::Rgbd8}) {
    const WriteFacts facts = write_image(folder / "a.dds", image, {.type = type});
    EXPECT_EQ(facts.clamped, 2) << pixel_type_name(type);
    EXPECT_EQ(facts.not_a_number, 1) << pixel_type_name(type);
    EXPECT_EQ(facts.largest_clamped, 300) << pixel_type_name(type);
  }
}

TEST_F(Tables, RgbdHoldsValuesAboveOneAndKeepsItsDivisorWhereNoneIs) {
  Layers image = make_layers({4, 4}, {"R", "G", "B"});
  image.layers[0].plane.at(0, 0) = 0.9f;
  image.layers[1].plane.at(1, 0) = 6.5f;
  image.layers[2].plane.at(2, 0) = 255.0f;
  for (const char* name : {"a.png", "a.dds", "a.ktx2"}) {
    EXPECT_EQ(write_image(folder / name, image, {.type = PixelType::Rgbd8}).clamped, 0);
    const std::vector<double> values = read_arrays(folder / name).front().values;
    EXPECT_EQ(values[3], 1.0) << name;
    EXPECT_NEAR(values[7] * 255, 39, 1e-4) << name;  // floor(255 / 6.5)
    EXPECT_NEAR(rgbd(values, 0, 0), 0.9, 0.005) << name;
    EXPECT_NEAR(rgbd(values, 1, 1), 6.5, 0.03) << name;
    EXPECT_NEAR(rgbd(values, 2, 2), 255, 1e-3) << name;
    EXPECT_EQ(rgbd(values, 0, 1), 0) << name;
  }
  EXPECT_THAT(fault_text(Fault::Usage,
                         [&] {
                           write_image(folder / "a.png", pattern({4, 4}, {"R", "G", "B", "A"}),
                                       {.type = PixelType::Rgbd8});
                         }),
              HasSubstr("found 4 channels; rgbd8 holds 1 to 3"));
}

TEST_F(Tables, TexturesRefuseFiveChannels) {
  for (const char* name : {"a.dds", "a.ktx2"}) {
    EXPECT_THAT(
        fault_text(Fault::Usage,
                   [&] {
                     write_image(folder / name, pattern({4, 4}, {"R", "G", "B", "A", "Z"}), {});
                   }),
        HasSubstr("holds 1 to 4 channels"));
  }
}

TEST_F(Tables, RefuseSlicesAndLabelsThatDoNotFit) {
  const Layers image = pattern({4, 6}, {"E"});
  EXPECT_THAT(
      fault_text(Fault::Internal, [&] { write_image(folder / "a.npy", image, {.depth = 4}); }),
      HasSubstr("a.npy: 6 rows are no 4 slices"));
  const Labels labels{.axes = {{"mu", {0, 1, 2, 3}}, {"roughness", {0, 1}}}, .channels = {}};
  EXPECT_THAT(fault_text(Fault::Internal,
                         [&] {
                           write_image(folder / "a.csv", image,
                                       {.type = PixelType::Float, .labels = labels});
                         }),
              HasSubstr("axes are not those of the image"));
}

TEST_F(Tables, CsvIsOneEntryALineWithNamesAndCoordinates) {
  Layers image = make_layers({2, 2}, {"R", "G"});
  image.layers[0].plane.at(1, 0) = 0.25f;
  image.layers[1].plane.at(0, 1) = -1e-7f;
  WriteOptions options{.type = PixelType::Float, .attributes = {{"table", "split-sum\nx"}}};
  options.labels = {.axes = {{"mu", {0.25, 0.75}}, {"a, b", {1.0 / 3.0, 1}}},
                    .channels = {"scale", "bias"}};
  write_image(folder / "a.csv", image, options);
  EXPECT_EQ(bytes_of(folder / "a.csv"),
            "# table: split-sum x\nmu,\"a, b\",scale,bias\n0.25,0.333333333,0,0\n"
            "0.75,0.333333333,0.25,0\n0.25,1,0,-1.00000001e-07\n0.75,1,0,0\n");
  const NumberArray array = read_arrays(folder / "a.csv").front();
  EXPECT_THAT(array.shape, ElementsAre(2, 2, 2));
  EXPECT_THAT(array.columns, ElementsAre("mu", "a, b"));
  EXPECT_THAT(array.channels, ElementsAre("scale", "bias"));
  EXPECT_THAT(array.attributes,
              ElementsAre(std::pair<std::string, std::string>{"table", "split-sum x"}));
}

TEST_F(Tables, CsvOfAVolumeCountsSlicesInZ) {
  write_image(folder / "a.csv", pattern({2, 6}, {"E"}), {.type = PixelType::Float, .depth = 3});
  EXPECT_THAT(bytes_of(folder / "a.csv"), testing::StartsWith("x,y,z,E\n0,0,0,0\n1,0,0,"));
  const NumberArray array = read_arrays(folder / "a.csv").front();
  EXPECT_THAT(array.shape, ElementsAre(3, 2, 2, 1));
  EXPECT_THAT(array.columns, ElementsAre("x", "y", "z"));
}

TEST_F(Tables, KtxNamesItsWriterAndKeepsKeysInOrder) {
  const Attributes attributes{{"table", "e"}, {"Software", "kiln 1.2.3"}, {"axes", "mu"}};
  write_image(folder / "a.ktx2", pattern({4, 4}, {"E"}), {.attributes = attributes});
  const std::string bytes = bytes_of(folder / "a.ktx2");
  const std::array keys{bytes.find(std::string("KTXorientation\0rd\0", 18)),
                        bytes.find(std::string("KTXwriter\0kiln 1.2.3\0", 21)),
                        bytes.find(std::string("axes\0mu\0", 8)),
                        bytes.find(std::string("table\0e\0", 8))};
  EXPECT_TRUE(std::is_sorted(keys.begin(), keys.end()));
  EXPECT_NE(keys.back(), std::string::npos);
  EXPECT_THAT(fault_text(Fault::Usage,
                         [&] {
                           write_image(folder / "b.ktx2", pattern({4, 4}, {"E"}),
                                       {.attributes = {{"KTXfoo", "x"}}});
                         }),
              HasSubstr("b.ktx2: metadata name 'KTXfoo'"));
}

// The descriptor of RG in half: two samples of 16 bits, signed floats from -1 to 1.
TEST_F(Tables, KtxDescribesItsTexels) {
  write_image(folder / "a.ktx2", pattern({4, 4}, {"R", "G"}), {});
  const std::string bytes = bytes_of(folder / "a.ktx2");
  std::vector<uint32_t> words(bytes.size() / 4);
  std::memcpy(words.data(), bytes.data(), words.size() * 4);
  EXPECT_THAT(std::vector(words.begin() + 3, words.begin() + 12),
              ElementsAre(83, 2, 4, 4, 0, 0, 1, 1, 0));
  const size_t at = words[12] / 4;
  EXPECT_THAT(std::vector(words.begin() + static_cast<std::ptrdiff_t>(at),
                          words.begin() + static_cast<std::ptrdiff_t>(at) + 15),
              ElementsAre(60, 0, 2 | 56 << 16, 1 | 1 << 16, 0, 4, 0,                //
                          0 | 15 << 16 | 0xc0u << 24, 0, 0xbf800000u, 0x3f800000u,  //
                          16 | 15 << 16 | 0xc1u << 24, 0, 0xbf800000u, 0x3f800000u));
}

TEST_F(Tables, NpyHeadersEndOnAMultipleOf64) {
  write_image(folder / "a.npy", pattern({6, 3}, {"R", "G"}), {});
  const std::string bytes = bytes_of(folder / "a.npy");
  const std::string header = "{'descr': '<f2', 'fortran_order': False, 'shape': (3, 6, 2), }";
  EXPECT_EQ(bytes.substr(10, header.size()), header);
  EXPECT_EQ(bytes[127], '\n');
  EXPECT_EQ(bytes.size(), 128u + 6 * 3 * 2 * 2);
}

// Compiles a program that reads the header, by both compilers.
class CHeader : public Tables {
 protected:
  void expect_compiles(const std::string& header, const std::string& expression) const {
    const std::string program = "#include \"" + header + "\"\n#include \"" + header +
                                "\"\nint main(void) { return (" + expression + ") ? 0 : 1; }\n";
    write_bytes("program.c", program);
    write_bytes("program.cpp", program);
    const std::string flags =
        " -Wall -Wextra -pedantic -Werror -o " + (folder / "program").string();
    for (const std::string& command : {std::string(KILN_C_COMPILER) + " -std=c99" + flags + " " +
                                           (folder / "program.c").string(),
                                       std::string(KILN_CXX_COMPILER) + " -std=c++20" + flags +
                                           " " + (folder / "program.cpp").string()}) {
      EXPECT_EQ(std::system(command.c_str()), 0) << command;
      EXPECT_EQ(std::system((folder / "program").c_str()), 0) << command;
    }
  }
};

TEST_F(CHeader, CompilesAsCAndAsCpp) {
  if (std::string(KILN_C_COMPILER).empty()) GTEST_SKIP() << "no C compiler was found";
  Layers image = pattern({3, 2}, {"scale", "bias"});
  image.layers[0].plane.at(2, 1) = 0.1f;
  const Attributes attributes{{"table", "ends /* here */ \\"}, {"models", "ggx ?\?/"}};
  write_image(folder / "split-sum 2.h", image,
              {.type = PixelType::Float, .attributes = attributes});
  expect_compiles("split-sum 2.h",
                  "sizeof split_sum_2 == 12 * sizeof(float) && split_sum_2[1][2][0] == 0.1f");
  write_image(folder / "double.h", image, {.type = PixelType::Half});
  expect_compiles("double.h", "table_double[1][2][0] == 0x2e66");
  write_image(folder / "3d.h", image, {.type = PixelType::Uint8, .depth = 2});
  expect_compiles("3d.h", "sizeof table_3d == 12 && table_3d[1][0][2][0] == 26");
  image.layers[1].plane.at(0, 0) = NAN;
  image.layers[1].plane.at(1, 0) = -INFINITY;
  write_image(folder / "odd.h", image, {.type = PixelType::Float});
  expect_compiles("odd.h", "odd[0][0][1] != odd[0][0][1] && odd[0][1][1] < -1e38f");
}

TEST_F(CHeader, SaysHowToDecodeAndWhatItHolds) {
  write_image(folder / "e.h", pattern({4, 2}, {"scale", "bias"}),
              {.type = PixelType::Half, .attributes = {{"axes", "mu, roughness"}}});
  const std::string text = bytes_of(folder / "e.h");
  EXPECT_THAT(text, HasSubstr("e[y][x][channel], channels scale, bias; entries are the bits of "
                              "IEEE 754 binary16"));
  EXPECT_THAT(text, HasSubstr("static const unsigned short e[2][4][2] = {"));
  EXPECT_THAT(read_arrays(folder / "e.h").front().attributes,
              Contains(std::pair<std::string, std::string>{"axes", "mu, roughness"}));
}

TEST_F(Tables, AFloatTableIsFastToWriteWhereItIsNotPacked) {
  const Layers image = pattern({64, 64}, {"R", "G"});
  write_image(folder / "fast.exr", image, {.type = PixelType::Float, .packing = Packing::Fast});
  write_image(folder / "zip.exr", image, {.type = PixelType::Float});
  EXPECT_GT(bytes_of(folder / "fast.exr").size(), 64u * 64 * 8);
  EXPECT_LT(bytes_of(folder / "zip.exr").size(), 64u * 64 * 8);
  EXPECT_EQ(read_image(folder / "fast.exr").image.find("G")->at(9, 9), image.find("G")->at(9, 9));
}

}  // namespace
}  // namespace kiln
