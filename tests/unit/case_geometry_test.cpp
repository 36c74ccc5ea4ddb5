// Capsules must have room in the box: clear of walls, of each other, of their periodic images.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "driver/case/case_geometry.hpp"
#include "tests/unit/case_samples.hpp"

namespace {

using namespace tanktread::testing;
using ::testing::AllOf;
using ::testing::HasSubstr;

TEST(CaseGeometry, BoxAndWalls) {
  EXPECT_THAT(refusal(least_case, {"capsule.0.position.0=37"}), HasSubstr("x must be from 0 to 36"));
  EXPECT_THAT(refusal(least_case, {"capsule.0.position.2=-1"}), HasSubstr("z must be from 0 to 44"));
  EXPECT_THAT(refusal(droplet_case, {"capsule.0.position.1=33"}), HasSubstr("y must be from 0 to 32"));
  // cosine4 reaches 2 grid steps: 6 + 2 = 8 from the wall is the nearest place.
  EXPECT_EQ(refusal(least_case, {"capsule.0.position.2=8"}), "");
  EXPECT_THAT(refusal(least_case, {"capsule.0.position.2=7.9"}),
              AllOf(HasSubstr("leaves 1.9 grid steps between capsule and wall"),
                    HasSubstr("cosine4 reaches 2"), HasSubstr("z must be from 8 to 36")));
  EXPECT_EQ(refusal(least_case, {"capsule.0.position.2=7.5", "coupler.kernel=roma3"}), "");
  EXPECT_THAT(refusal(least_case, {"capsule.0.radius=21"}), HasSubstr("x; make the radius less than 18"));
  EXPECT_THAT(refusal(least_case, {"flow.box.2=15"}), HasSubstr("outside the box"));
  EXPECT_THAT(
      refusal(least_case, {"flow.box.2=15", "capsule.0.position.2=7.5"}),
      HasSubstr(
          "flow.box along z must be at least 16, or the radius at most 5.5, and the capsule midway between"));
  // On the other axes the box is periodic: a capsule may lie across its faces.
  EXPECT_EQ(refusal(least_case, {"capsule.0.position=[0, 40, 22]"}), "");
}

TEST(CaseGeometry, Overlaps) {
  const auto second = [](const std::string& position) {
    return least_case + "[[capsule]]\nradius = 5\nposition = " + position + "\n";
  };
  EXPECT_EQ(refusal(second("[29.1, 20, 22]")), "");
  EXPECT_THAT(
      refusal(second("[28.9, 20, 22]")),
      HasSubstr("capsule.1.position = [28.9, 20, 22]: overlaps capsule 0: the centres are 10.9 grid steps "
                "apart, the radii sum to 11"));
  // Across the periodic face: 2 and 35 are 3 apart in a box of 36.
  EXPECT_THAT(refusal(second("[35, 20, 22]"), {"capsule.0.position.0=2"}),
              HasSubstr("are 3 grid steps apart"));
}

TEST(CaseGeometry, FluidBox) {
  EXPECT_EQ(refusal(least_case, {"output.fluid_box=[[0, 35], [20, 20], [0, 43]]"}), "");
  EXPECT_THAT(refusal(least_case, {"output.fluid_box=[[0, 36], [20, 20], [0, 43]]"}),
              HasSubstr("along x it must be [first, last] with 0 <= first <= last <= 35"));
  EXPECT_THAT(refusal(least_case, {"output.fluid_box=[[0, 35], [21, 20], [0, 43]]"}), HasSubstr("along y"));
}

TEST(CaseGeometry, Distances) {
  auto the_case = parse(full_case);  // walls across y
  auto &first = the_case.capsules[0], &second = the_case.capsules[1];
  first.position = {1, 10, 2};
  second.position = {38, 14, 2};
  // 37 along the periodic x of 40 is 3 to the nearest image; 4 along y: 5 by Pythagoras.
  EXPECT_EQ(tanktread::driver::distance_between(the_case, first, second), 5.0);
  // A wall does not repeat: 48 along y stays 48.
  first.position = {1, 1, 2};
  second.position = {1, 49, 2};
  EXPECT_EQ(tanktread::driver::distance_between(the_case, first, second), 48.0);
  EXPECT_EQ(tanktread::driver::gap_to_walls(the_case, second, 1, {7, 5}), 50.0 - 49.0 - 5.0);
  EXPECT_EQ(tanktread::driver::gap_to_walls(the_case, first, 1, {7, 5}), 1.0 - 7.0);
}

}  // namespace
