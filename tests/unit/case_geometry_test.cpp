// Capsules must have room in the box: clear of walls, of each other, of their periodic images.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "driver/case/case_geometry.hpp"
#include "driver/case/names.hpp"
#include "tests/unit/case_samples.hpp"

namespace {

using namespace tanktread::testing;
using ::testing::AllOf;
using ::testing::HasSubstr;

TEST(CaseGeometry, BoxAndWalls) {
  EXPECT_THAT(refusal(least_case, {"capsule.0.position.0=37"}), HasSubstr("x must be from 0 to 36"));
  EXPECT_THAT(refusal(least_case, {"capsule.0.position.2=-1"}), HasSubstr("z must be from 0 to 44"));
  EXPECT_THAT(refusal(droplet_case, {"capsule.0.position.1=33"}), HasSubstr("y must be from 0 to 32"));
  // stockie6 reaches 3 grid steps: 6 + 3 = 9 from the wall is the nearest place.
  EXPECT_EQ(refusal(least_case, {"capsule.0.position.2=9"}), "");
  EXPECT_THAT(
      refusal(least_case, {"capsule.0.position.2=8.9"}),
      AllOf(HasSubstr("leaves 2.9 grid steps between capsule and wall"), HasSubstr("stockie6 reaches 3"),
            HasSubstr("z must be from 9 to 35"), HasSubstr("coupler.kernel = \"peskin4\", which reaches 2")));
  EXPECT_EQ(refusal(least_case, {"capsule.0.position.2=7.5", "coupler.kernel=roma3"}), "");
  EXPECT_THAT(refusal(least_case, {"capsule.0.radius=21"}), HasSubstr("x; make the radius less than 18"));
  EXPECT_THAT(refusal(least_case, {"flow.box.2=15"}), HasSubstr("outside the box"));
  EXPECT_THAT(
      refusal(least_case, {"flow.box.2=15", "capsule.0.position.2=7.5"}),
      HasSubstr(
          "flow.box along z must be at least 18, or the radius at most 4.5, and the capsule midway between"));
  // On the other axes the box is periodic: a capsule may lie across its faces.
  EXPECT_EQ(refusal(least_case, {"capsule.0.position=[0, 40, 22]"}), "");
}

/// The kernel that a refusal names as a fix, or "".
std::string suggested_kernel(const std::string& message) {
  const std::string before = "or coupler.kernel = \"";
  const auto at = message.find(before);
  if (at == std::string::npos) return "";
  const auto name = at + before.size();
  return message.substr(name, message.find('"', name) - name);
}

/// A case is refused for the kernel and for a place without room: the first kernel of the table that fits is
/// named and does fit, and none is named only if none fits.
void expect_a_kernel_that_fits(const std::string& kernel, const std::vector<std::string>& without_room) {
  const auto with = [&](const std::string& name) {
    auto assignments = without_room;
    assignments.push_back("coupler.kernel=" + name);
    return refusal(least_case, assignments);
  };
  std::string first_that_fits;
  for (const auto& name : tanktread::driver::kernel_names()) {
    if (first_that_fits.empty() && with(name).empty()) first_that_fits = name;
  }
  EXPECT_THAT(with(kernel), HasSubstr("the kernel " + kernel + " "));
  EXPECT_EQ(suggested_kernel(with(kernel)), first_that_fits) << with(kernel);
}

TEST(CaseGeometry, ANearWallIsRefusedWithAKernelThatFits) {
  for (const auto& kernel : tanktread::driver::kernel_names()) {
    for (const double gap : {0.5, 0.9, 1.0, 1.2, 1.5, 1.9, 2.0, 2.5, 2.9}) {
      if (gap >= *tanktread::driver::kernel_half_width(kernel)) continue;
      for (const double z : {6 + gap, 44 - 6 - gap}) {
        SCOPED_TRACE(kernel + " at z = " + std::to_string(z));
        expect_a_kernel_that_fits(kernel, {"capsule.0.position.2=" + std::to_string(z)});
      }
    }
  }
  // The narrowest, linear2, reaches 1.
  const auto none = refusal(least_case, {"capsule.0.position.2=6.9"});
  EXPECT_THAT(none, HasSubstr("leaves 0.9 grid steps"));
  EXPECT_EQ(suggested_kernel(none), "");
  EXPECT_TRUE(none.ends_with("z must be from 9 to 35")) << none;
}

TEST(CaseGeometry, ABoxNarrowerThanTheKernelIsRefusedWithAKernelThatFits) {
  for (const std::string nodes : {"4", "5"}) {
    const std::vector<std::string> narrow = {"flow.box.1=" + nodes, "capsule.0.position.1=2",
                                             "capsule.0.radius=1.5"};
    EXPECT_THAT(refusal(least_case, narrow),
                AllOf(HasSubstr("flow.box"), HasSubstr("has " + nodes + " nodes along y"),
                      HasSubstr("stockie6 is 6 wide"), HasSubstr("make it at least that"),
                      HasSubstr("coupler.kernel = \"peskin4\"")));
    expect_a_kernel_that_fits("stockie6", narrow);
  }
  EXPECT_EQ(refusal(least_case, {"flow.box.1=6", "capsule.0.position.1=3", "capsule.0.radius=1.5"}), "");
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
