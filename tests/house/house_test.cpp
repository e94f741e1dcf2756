// SPDX-License-Identifier: Apache-2.0
// The floor plan as a test: the project as it stands keeps every rule of docs/architecture.md.
#include "house.h"

#include <gtest/gtest.h>

#include <iostream>

#include "rules.h"
#include "support/places.h"

namespace kiln::test {
namespace {

const House& this_house() {
  static const House house = read_house(source_folder(), build_folder() / "house.txt");
  return house;
}

void expect_none(const Breaches& breaches) {
  for (const std::string& breach : breaches) ADD_FAILURE() << breach;
}

TEST(House, HasAPlanAndSources) {
  EXPECT_GE(this_house().plan.size(), 15u);
  EXPECT_GE(this_house().sources.size(), 50u);
}

TEST(House, IncludesOnlyWhatThePlanAllows) {
  expect_none(includes_that_the_plan_forbids(this_house()));
}

TEST(House, LetsNoRoomLookUp) { expect_none(arrows_that_point_up(this_house())); }

TEST(House, HasNoCircleOfRooms) { expect_none(rooms_in_a_cycle(this_house())); }

TEST(House, HasEveryRoomInThePlanAndOnDisk) {
  expect_none(rooms_missing_from_plan_or_disk(this_house()));
}

TEST(House, IsDrawnAsItIsBuilt) { expect_none(rooms_drawn_otherwise(this_house())); }

TEST(House, KeepsThirdPartyHeadersInTheirOneRoom) {
  expect_none(third_party_headers_outside_their_room(this_house()));
}

TEST(House, ShowsNoThirdPartyTypeInAPublicHeader) {
  expect_none(third_party_types_in_public_headers(this_house()));
}

TEST(House, OpensEveryFileWithItsLicence) { expect_none(files_without_licence_line(this_house())); }

TEST(House, NamesNoFileAfterNothing) { expect_none(files_with_forbidden_names(this_house())); }

TEST(House, ExitsAndPrintsOnlyInTheCommand) {
  expect_none(exits_and_prints_outside_the_command(this_house()));
}

TEST(House, CatchesOnlyAtTheDoors) { expect_none(catches_away_from_the_doors(this_house())); }

TEST(House, IsBuiltWithoutFastMath) { expect_none(fast_math_flags(this_house())); }

TEST(House, ReportsFilesBeyond600Lines) {
  for (const std::string& file : files_longer_than(this_house(), 600))
    std::cout << "long: " << file << '\n';
}

}  // namespace
}  // namespace kiln::test
