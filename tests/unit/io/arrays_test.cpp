// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <clocale>
#include <cmath>

#include "crafted_files.h"
#include "image_folder.h"
#include "kiln/io/number_arrays.h"
#include "support/real_data.h"

namespace kiln {
namespace {

using namespace test;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using Stored = NumberArray::Stored;

class Arrays : public ImageFolder {
 protected:
  std::vector<NumberArray> arrays(const std::string& name, const std::string& text) const {
    return read_arrays(write_bytes(name, text));
  }
  NumberArray only(const std::string& name, const std::string& text) const {
    std::vector<NumberArray> found = arrays(name, text);
    EXPECT_EQ(found.size(), 1u);
    return found.front();
  }
  std::string refusal(const std::string& name, const std::string& text) const {
    return fault_text(Fault::Input, [&] { arrays(name, text); });
  }
};

// "0, 1, 2, ..."
std::string counting(int count, const std::string& between = ", ", const std::string& suffix = "") {
  std::string text;
  for (int i = 0; i < count; ++i) text += (i > 0 ? between : "") + std::to_string(i) + suffix;
  return text;
}

std::string npy(const std::string& dictionary, const std::string& numbers, int version = 1) {
  const std::string header = dictionary + "\n";
  return "\x93NUMPY" + std::string(1, static_cast<char>(version)) + '\0' +
         little_endian(static_cast<uint32_t>(header.size()), version == 1 ? 2 : 4) + header +
         numbers;
}

std::string described(const std::string& type, const std::string& shape, bool fortran = false) {
  return "{'descr': '" + type + "', 'fortran_order': " + (fortran ? "True" : "False") +
         ", 'shape': (" + shape + "), }";
}

TEST_F(Arrays, NpyIsReadInEveryTypeAndByteOrder) {
  EXPECT_THAT(only("a.npy", npy(described("<f2", "1, 2"), std::string("\0\x3c\0\x34", 4))).values,
              ElementsAre(1, 0.25));
  EXPECT_THAT(
      only("a.npy", npy(described(">f4", "2,"), std::string("\x3f\x80\0\0\x40\0\0\0", 8))).values,
      ElementsAre(1, 2));
  const NumberArray wide =
      only("a.npy", npy(described("<f8", "1,"), std::string("\0\0\0\0\0\0\xf8\x3f", 8), 2));
  EXPECT_THAT(wide.values, ElementsAre(1.5));
  EXPECT_EQ(wide.stored, Stored::Double);
  EXPECT_THAT(only("a.npy", npy(described("|u1", "2,"), "\x33\xff", 3)).values,
              ElementsAre(0.2, 1));
  EXPECT_THAT(only("a.npy", npy(described(">u2", "1,"), "\x33\x33")).values, ElementsAre(0.2));
  EXPECT_THAT(only("a.npy", npy(described("<i2", "2,"), "\xfe\xff\x03\x01")).values,
              ElementsAre(-2, 259));
  EXPECT_THAT(only("a.npy", npy(described(">i4", "1,"), "\xff\xff\xff\xfd")).values,
              ElementsAre(-3));
  EXPECT_THAT(only("a.npy", npy(described("<u4", "1,"), "\xff\xff\xff\xff")).values,
              ElementsAre(4294967295.0));
}

TEST_F(Arrays, NpyInFortranOrderHasItsFirstIndexFastest) {
  const NumberArray array = only("a.npy", npy(described("|i1", "2, 3, 2", true),
                                              std::string("\0\1\2\3\4\5\6\7\x8\x9\xa\xb", 12)));
  EXPECT_THAT(array.shape, ElementsAre(2, 3, 2));
  EXPECT_THAT(array.values, ElementsAre(0, 6, 2, 8, 4, 10, 1, 7, 3, 9, 5, 11));
}

TEST_F(Arrays, NpySaysWhatItCannotRead) {
  EXPECT_THAT(refusal("a.npy", npy(described("<c8", "1,"), "12345678")),
              HasSubstr("numbers of type '<c8' are not read"));
  EXPECT_THAT(refusal("a.npy", npy(described("<f4", "2, 2"), "1234")),
              HasSubstr("truncated: the header claims 4 numbers of 4 bytes, 4 bytes follow"));
  EXPECT_THAT(refusal("a.npy", npy(described("<f4", "99999, 99999, 99999"), "1234")),
              HasSubstr("are not read"));
  EXPECT_THAT(refusal("a.npy", npy("{'shape': (1,)}", "1234")), HasSubstr("it has no 'descr'"));
}

TEST_F(Arrays, AMatrixOfTextIsAMatrixInAnySeparation) {
  for (const char* text : {"1,2,3\n4,5,6.5\n", "1;2;3\r\n4;5;6,5\r\n", "1\t2\t3\n4\t5\t6.5",
                           "  1 2   3\n 4 5 6.5  \n\n", "# note\n1 2 3 # one\n4 5 0x1.ap2\n",
                           "1, 2, 3,\n4, 5, 6.5,\n"}) {
    const NumberArray array = only("a.csv", text);
    EXPECT_THAT(array.shape, ElementsAre(2, 3)) << text;
    EXPECT_THAT(array.values, ElementsAre(1, 2, 3, 4, 5, 6.5)) << text;
    EXPECT_EQ(array.stored, Stored::Decimal);
  }
}

TEST_F(Arrays, OneNumberALineIsARow) {
  const NumberArray array = only("a.txt", "# table: E\n0x3c00\n7\n-2\n");
  EXPECT_THAT(array.shape, ElementsAre(3));
  EXPECT_THAT(array.values, ElementsAre(15360, 7, -2));
  EXPECT_EQ(array.stored, Stored::Integer);
  EXPECT_THAT(array.attributes, ElementsAre(std::pair<std::string, std::string>{"table", "E"}));
}

TEST_F(Arrays, AShortLastLineMakesARowOfAll) {
  EXPECT_THAT(only("a.inc", "1, 2, 3,\n4, 5, 6,\n7").shape, ElementsAre(7));
}

TEST_F(Arrays, CoordinatesGiveTheShapeInWhateverOrderRowsCome) {
  const NumberArray sorted = only("a.csv", "mu,r,A,B\n0,1,1,2\n0.5,1,3,4\n0,0,5,6\n0.5,0,7,8\n");
  EXPECT_THAT(sorted.shape, ElementsAre(2, 2, 2));
  EXPECT_THAT(sorted.values, ElementsAre(1, 2, 3, 4, 5, 6, 7, 8));  // r falls, as in the file
  EXPECT_THAT(sorted.columns, ElementsAre("mu", "r"));
  EXPECT_THAT(sorted.channels, ElementsAre("A", "B"));
  const NumberArray transposed =
      only("a.csv", "mu r E\n0 0 1\n0 1 2\n0 2 3\n1 0 4\n1 1 5\n1 2 6\n");
  EXPECT_THAT(transposed.shape, ElementsAre(3, 2, 1));
  EXPECT_THAT(transposed.values, ElementsAre(1, 4, 2, 5, 3, 6));
  const NumberArray shuffled =
      only("a.csv", "mu,r,E\n1,1,5\n0,2,3\n2,0,7\n1,0,4\n0,1,2\n2,2,9\n0,0,1\n2,1,8\n1,2,6\n");
  EXPECT_THAT(shuffled.shape, ElementsAre(3, 3, 1));
  EXPECT_THAT(shuffled.values, ElementsAre(1, 4, 7, 2, 5, 8, 3, 6, 9));
  const NumberArray line = only("a.csv", "roughness,E\n0,1\n0.5,0.9\n1,0.4\n");
  EXPECT_THAT(line.shape, ElementsAre(3, 1));
  EXPECT_THAT(line.columns, ElementsAre("roughness"));
}

TEST_F(Arrays, AHeaderWithoutCoordinatesNamesTheColumns) {
  const NumberArray array = only("a.csv", "R,G,B\n1,2,3\n4,5,6\n");
  EXPECT_THAT(array.shape, ElementsAre(2, 3));
  EXPECT_THAT(array.channels, ElementsAre("R", "G", "B"));
  EXPECT_THAT(array.columns, IsEmpty());
}

TEST_F(Arrays, ATableNamesTheLineThatDiffers) {
  EXPECT_THAT(refusal("a.csv", "a,b\n1,2\n3,4,5\n6,7\n"),
              HasSubstr("a.csv: line 3: found 3 columns, expected 2 as in line 2"));
  EXPECT_THAT(refusal("a.csv", "# c\n1,2\n3,four\n"),
              HasSubstr("a.csv: line 3: found 'four', expected a number"));
}

TEST_F(Arrays, CDeclarationsGiveNamesAndShapes) {
  const std::string text =
      "#pragma once\n/* lut: two\n * axes: mu, r\n */\n"
      "// { 1, 2 }\nstatic const float flat[4][2][2] = { " +
      counting(16, ", ", ".0f") + " };\nconstexpr std::array<float, 16> wrapped = {{" +
      counting(16) + "}};\nconst unsigned short nested[8][2] = {\n" +
      "{0x3c00, 1}, {2, 3}, {4, 5}, {6, 7}, /* half */ {8, 9}, {10, 11}, "
      "{12, 13}, {14, -15} };\nint few[3] = {1, 2, 3};\n"
      "float open[][N] = {" +
      counting(20, " , ", ".5e-1f") + "};\n";
  const std::vector<NumberArray> found = arrays("a.h", text);
  ASSERT_EQ(found.size(), 4u);
  EXPECT_EQ(found[0].name, "flat");
  EXPECT_THAT(found[0].shape, ElementsAre(4, 2, 2));
  EXPECT_EQ(found[0].stored, Stored::Decimal);
  EXPECT_THAT(found[0].notes, ElementsAre("declared as static const float"));
  EXPECT_THAT(found[0].attributes,
              ElementsAre(std::pair<std::string, std::string>{"lut", "two"},
                          std::pair<std::string, std::string>{"axes", "mu, r"}));
  EXPECT_EQ(found[1].name, "wrapped");
  EXPECT_THAT(found[1].shape, ElementsAre(16));
  EXPECT_EQ(found[2].name, "nested");
  EXPECT_THAT(found[2].shape, ElementsAre(8, 2));
  EXPECT_EQ(found[2].stored, Stored::Integer);
  EXPECT_EQ(found[2].values[0], 0x3c00);
  EXPECT_EQ(found[2].values[15], -15);
  EXPECT_EQ(found[3].name, "open");
  EXPECT_THAT(found[3].shape, ElementsAre(20));
  EXPECT_DOUBLE_EQ(found[3].values[2], 0.25);
}

TEST_F(Arrays, ScriptsNameTheirArraysByVariableMemberOrKey) {
  const std::string list = "[ " + counting(16) + " ]";
  const std::string text =
      "import { x } from 'y';\nconst DATA = new Uint16Array( " + list + " );\n" +
      "const odd = \"don't\", it = [1, 'two'];\nthis.table = new Float32Array(" + list + ");\n" +
      "let typed: number[] = " + list + ";\nexport default { size: 4, 'a b': " + list +
      ", rows: [[0,1,2,3],[4,5,6,7],[8,9,10,- 11],[12,13,14,.15e2]] };\nfoo([1 - 2, 3]);";
  const std::vector<NumberArray> found = arrays("a.js", text);
  ASSERT_EQ(found.size(), 5u);
  std::vector<std::string> names;
  for (const NumberArray& array : found) names.push_back(array.name);
  EXPECT_THAT(names, ElementsAre("DATA", "table", "typed", "a b", "rows"));
  EXPECT_THAT(found[0].shape, ElementsAre(16));
  EXPECT_THAT(found[0].notes, ElementsAre("declared as const Uint16Array"));
  EXPECT_THAT(found[4].shape, ElementsAre(4, 4));
  EXPECT_EQ(found[4].values[11], -11);
  EXPECT_EQ(found[4].values[15], 15);
}

TEST_F(Arrays, JsonAndPythonAreReadAlike) {
  const NumberArray json = only("a.json", "{ \"name\": \"e\", \"values\": [[" + counting(8) +
                                              "], [" + counting(8) + "]], \"n\": 3 }");
  EXPECT_EQ(json.name, "values");
  EXPECT_THAT(json.shape, ElementsAre(2, 8));
  const std::vector<NumberArray> python =
      arrays("a.py", "import numpy as np # it's\nE = np.array([" + counting(16) + "])\nF = (" +
                         counting(16) + ")\n");
  ASSERT_EQ(python.size(), 2u);
  EXPECT_EQ(python[0].name, "E");
  EXPECT_EQ(python[1].name, "F");
}

TEST_F(Arrays, ARaggedListIsARow) {
  const NumberArray array = only("a.js", "x = [[" + counting(10) + "], [" + counting(9) + "]]");
  EXPECT_THAT(array.shape, ElementsAre(19));
}

std::string base64(const std::string& bytes) {
  constexpr std::string_view digits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (size_t i = 0; i < bytes.size(); i += 3) {
    uint32_t bits = 0;
    for (size_t k = 0; k < 3; ++k) {
      bits = bits << 8 | (i + k < bytes.size() ? static_cast<uint8_t>(bytes[i + k]) : 0u);
    }
    for (size_t k = 0; k < 4; ++k) {
      text += i + k <= bytes.size() ? digits[bits >> (18 - 6 * k) & 63] : '=';
    }
  }
  return text;
}

TEST_F(Arrays, APngInsideAScriptIsAnImage) {
  write_image(folder / "a.png", pattern({8, 4}, {"R", "G", "B"}), {.type = PixelType::Uint8});
  const std::string encoded = base64(bytes_of(folder / "a.png"));
  const NumberArray array =
      only("a.js", "const lut = \"data:image/png;base64," + encoded + "\";\nuse(lut, [1, 2]);\n");
  EXPECT_EQ(array.name, "lut");
  EXPECT_THAT(array.shape, ElementsAre(4, 8, 3));
  EXPECT_EQ(array.stored, Stored::Uint8);
  EXPECT_NEAR(array.values[3], 7.0 / 255, 1e-9);
}

TEST_F(Arrays, APalettePngIsItsColours) {
  CraftedPng image{.width = 4, .height = 4, .color_type = 3};
  image.before_pixels = png_chunk("PLTE", std::string("\0\0\0\x33\x66\xff", 6));
  image.rows = std::vector<std::string>(4, std::string("\0\1\0\1", 4));
  const NumberArray array = only("a.png", png(image));
  EXPECT_THAT(array.shape, ElementsAre(4, 4, 3));
  EXPECT_NEAR(array.values[3], 0.2, 1e-7);
  EXPECT_NEAR(array.values[4], 0.4, 1e-7);
  EXPECT_NEAR(array.values[5], 1, 1e-7);
}

TEST_F(Arrays, ReadsEveryPictureFormat) {
  for (const WritableFormat& format : picture_formats()) {
    const fs::path path = folder / named("a", format);
    write_image(path, pattern({6, 4}, {"R", "G", "B"}), {.type = format.types.front()});
    const NumberArray array = read_arrays(path).front();
    EXPECT_THAT(array.shape, ElementsAre(4, 6, 3)) << format.name;
    EXPECT_THAT(array.channels, ElementsAre("R", "G", "B")) << format.name;
  }
}

TEST_F(Arrays, SaysThatAFileHoldsNone) {
  EXPECT_THAT(refusal("a.md", "# Title\n\nSome words, and [a list](of words).\n"),
              HasSubstr("a.md: found no numbers in lines and no array of at least 16 numbers"));
  EXPECT_THAT(refusal("a.bin", std::string("\1\2\0\3", 4)), HasSubstr("neither an image, .npy"));
  EXPECT_THAT(fault_text(Fault::Input, [&] { read_arrays(folder / "none.csv"); }),
              HasSubstr("none.csv: no such file"));
}

TEST_F(Arrays, ATableMayBeginWithTheLettersOfAnImageFormat) {
  EXPECT_THAT(only("a.csv", "P1,P2\n5,2\n3,4\n5,6\n").values, ElementsAre(5, 2, 3, 4, 5, 6));
}

TEST_F(Arrays, AreReadWithoutRegardToTheLocale) {
  const std::string before = std::setlocale(LC_ALL, nullptr);
  const bool set = std::setlocale(LC_ALL, "de_DE.UTF-8") != nullptr ||
                   std::setlocale(LC_ALL, "fr_FR.UTF-8") != nullptr;
  if (!set) GTEST_SKIP() << "no locale with a decimal comma";
  EXPECT_THAT(only("a.csv", "0.5,1.5\n2.5,3.5\n").values, ElementsAre(0.5, 1.5, 2.5, 3.5));
  std::setlocale(LC_ALL, before.c_str());
}

TEST_F(Arrays, ReadsTablesOfCycles) {
  KILN_REQUIRE_REAL_DATA(data);
  const NumberArray array = read_arrays(data / "data/reference/cycles_table_ggx_E.txt").front();
  EXPECT_THAT(array.shape, ElementsAre(1024));
  EXPECT_EQ(array.values[1], 0.980405);
  const NumberArray fits = read_arrays(data / "data/reference/merl_fit_abc.csv").front();
  EXPECT_THAT(fits.shape, ElementsAre(100, 9));
  EXPECT_THAT(fits.notes, ElementsAre("column 'name' holds words; it was left out"));
}

}  // namespace
}  // namespace kiln
