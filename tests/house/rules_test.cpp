// SPDX-License-Identifier: Apache-2.0
// Each rule, shown a house that breaks it.
#include "rules.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace kiln::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

const std::string licence = "// SPDX-License-Identifier: Apache-2.0";

House house_with(const std::string& path, const std::string& line) {
  return {parse_plan("1 core: \n2 store: core\n4 io: store core\n7 pipeline: io core\n"),
          {},
          {{path, {licence, line}}},
          {"core", "io", "pipeline", "store"}};
}

TEST(HousePlan, IsReadLineByLine) {
  const Plan plan = parse_plan("1 core: \n4 io: store core\n");
  ASSERT_THAT(plan, SizeIs(2));
  EXPECT_EQ(plan.at("io").floor, 4);
  EXPECT_THAT(plan.at("io").may_include, ElementsAre("store", "core"));
}

TEST(HouseRules, ReportAForbiddenIncludeWithItsFileAndLine) {
  EXPECT_THAT(includes_that_the_plan_forbids(
                  house_with("src/store/a.cpp", "#include \"kiln/io/image_file.h\"")),
              ElementsAre("src/store/a.cpp:2: store includes io; it may include core, store"));
  EXPECT_THAT(includes_that_the_plan_forbids(
                  house_with("include/kiln/io/a.h", "#include \"kiln/store/b.h\"")),
              IsEmpty());
  EXPECT_THAT(
      includes_that_the_plan_forbids(house_with("src/io/a.cpp", "#include \"../store/b.h\"")),
      SizeIs(1));
}

TEST(HouseRules, ReportAnArrowToAHigherFloorAndToNowhere) {
  House house;
  house.plan = parse_plan("1 core: io\n4 io: cellar\n");
  EXPECT_THAT(arrows_that_point_up(house), SizeIs(2));
}

TEST(HouseRules, ReportACircleOfRooms) {
  House house;
  house.plan = parse_plan("4 io: color\n4 color: light\n4 light: io\n");
  EXPECT_THAT(rooms_in_a_cycle(house), ElementsAre(HasSubstr("color -> light -> io -> color")));
}

TEST(HouseRules, ReportARoomWithoutAPlanAndAPlanWithoutARoom) {
  House house = house_with("src/io/a.cpp", "");
  house.room_folders = {"core", "io", "pipeline", "cellar"};
  EXPECT_THAT(rooms_missing_from_plan_or_disk(house),
              ElementsAre(HasSubstr("cellar"), "house.txt: room store has no folder"));
}

TEST(HouseRules, ReportARoomThatIsDrawnOtherwise) {
  House house;
  house.plan = parse_plan("1 core: \n4 io: store core\n");
  house.drawing =
      parse_drawing({"| 1 | `core` | errors | - |", "| 4 | `io` | files | core, store |"});
  EXPECT_THAT(rooms_drawn_otherwise(house), IsEmpty());
  house.drawing = parse_drawing({"| 1 | `core` | errors | - |", "| 4 | `io` | files | core |"});
  EXPECT_THAT(
      rooms_drawn_otherwise(house),
      ElementsAre(
          "docs/architecture.md: io is drawn as floor 4, core; CMake says floor 4, core, store"));
}

TEST(HouseRules, ReportAThirdPartyHeaderAwayFromHome) {
  const std::string line = "#include <OpenImageIO/imageio.h>";
  EXPECT_THAT(third_party_headers_outside_their_room(house_with("src/io/a.cpp", line)), IsEmpty());
  EXPECT_THAT(third_party_headers_outside_their_room(house_with("src/store/a.cpp", line)),
              ElementsAre("src/store/a.cpp:2: includes OpenImageIO/imageio.h; only io may"));
}

TEST(HouseRules, ReportAThirdPartyTypeInAPublicHeader) {
  EXPECT_THAT(third_party_types_in_public_headers(
                  house_with("include/kiln/io/a.h", "#include <fmt/core.h>")),
              SizeIs(1));
  EXPECT_THAT(
      third_party_types_in_public_headers(house_with("include/kiln/io/a.h", "OIIO::ImageBuf b;")),
      SizeIs(1));
  EXPECT_THAT(
      third_party_types_in_public_headers(house_with("include/kiln/io/a.h", "#include <vector>")),
      IsEmpty());
}

TEST(HouseRules, ReportAMissingLicenceLine) {
  House house = house_with("src/io/a.cpp", "");
  EXPECT_THAT(files_without_licence_line(house), IsEmpty());
  house.sources[0].lines[0] = "#pragma once";
  EXPECT_THAT(files_without_licence_line(house), SizeIs(1));
  house.sources[0].lines = {"#!/usr/bin/env bash", "# SPDX-License-Identifier: Apache-2.0"};
  EXPECT_THAT(files_without_licence_line(house), IsEmpty());
}

TEST(HouseRules, ReportANameThatSaysNothing) {
  EXPECT_THAT(files_with_forbidden_names(house_with("src/io/file_utils.cpp", "")), SizeIs(1));
  EXPECT_THAT(files_with_forbidden_names(house_with("src/io/pixel_info.h", "")), SizeIs(1));
  EXPECT_THAT(files_with_forbidden_names(house_with("tests/support/real_data.h", "")), IsEmpty());
}

TEST(HouseRules, ReportExitsAndPrintsButNotFormatting) {
  EXPECT_THAT(exits_and_prints_outside_the_command(house_with("src/io/a.cpp", "  std::exit(1);")),
              SizeIs(1));
  EXPECT_THAT(exits_and_prints_outside_the_command(house_with("src/io/a.cpp", "  std::cerr << 1;")),
              SizeIs(1));
  EXPECT_THAT(
      exits_and_prints_outside_the_command(house_with("src/cli/a.cpp", "  std::cout << 1;")),
      IsEmpty());
  EXPECT_THAT(exits_and_prints_outside_the_command(
                  house_with("src/io/a.cpp", "  snprintf(text, 8, form);")),
              IsEmpty());
  EXPECT_THAT(
      exits_and_prints_outside_the_command(house_with("src/io/a.cpp", "  // exit(1) ends it")),
      IsEmpty());
}

TEST(HouseRules, ReportACatchAwayFromTheDoors) {
  const std::string line = "  } catch (const std::exception& error) {";
  EXPECT_THAT(catches_away_from_the_doors(house_with("src/table/a.cpp", line)), SizeIs(1));
  EXPECT_THAT(catches_away_from_the_doors(house_with("src/pipeline/check.cpp", line)), SizeIs(1));
  EXPECT_THAT(catches_away_from_the_doors(house_with("src/pipeline/runner.cpp", line)), IsEmpty());
  EXPECT_THAT(catches_away_from_the_doors(house_with("src/io/a.cpp", line)), IsEmpty());
}

TEST(HouseRules, ReportFastMathInABuildFileButNotInItsComment) {
  EXPECT_THAT(fast_math_flags(house_with("cmake/A.cmake", "add_compile_options(-ffast-math)")),
              SizeIs(1));
  EXPECT_THAT(fast_math_flags(house_with("cmake/A.cmake", "# No -ffast-math.")), IsEmpty());
}

TEST(HouseRules, ReportLongFiles) {
  EXPECT_THAT(files_longer_than(house_with("src/io/a.cpp", ""), 1),
              ElementsAre("src/io/a.cpp: 2 lines"));
}

}  // namespace
}  // namespace kiln::test
