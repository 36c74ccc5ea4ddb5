// Surfaces that have crumpled, and surfaces that only look as if they had.
#include "membrane/surface_check.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "membrane/membrane.hpp"
#include "membrane/meridian.hpp"
#include "membrane/revolved_mesh.hpp"

namespace tanktread::membrane::surface_check_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

std::string flaw_of(const TriangleMesh& mesh) {
  SurfaceCheck check(mesh.triangles);
  try {
    check.check(mesh.points);
  } catch (const InvertedElement& error) {
    return error.what();
  }
  return "";
}

/// Two pyramids, base to base, with the axis z: four sides each, corners of the base at 1 from the axis.
TriangleMesh bipyramid(double upper, double lower) {
  TriangleMesh mesh;
  mesh.points.resize(3, 6);
  mesh.points << 1, 0, -1, 0, 0, 0,  //
      0, 1, 0, -1, 0, 0,             //
      0, 0, 0, 0, upper, lower;
  mesh.triangles.resize(3, 8);
  mesh.triangles << 0, 1, 2, 3, 1, 2, 3, 0,  //
      1, 2, 3, 0, 0, 1, 2, 3,                //
      4, 4, 4, 4, 5, 5, 5, 5;
  return mesh;
}

TEST(SurfaceCheck, TakesEveryShapeThatTheProgramMakes) {
  for (int level = 1; level <= 4; ++level) {
    for (const double ratio : {least_aspect_ratio, 0.3, 1.0, 3.0, greatest_aspect_ratio})
      EXPECT_EQ(flaw_of(revolved_mesh(spheroid_meridian(5, ratio), level)), "") << level << ", " << ratio;
    EXPECT_EQ(flaw_of(revolved_mesh(biconcave_meridian(5), level)), "");
  }
}

// A side with its top at the height z over a base at 1/sqrt(2) from the axis is inclined by atan(sqrt(2) z);
// the two sides at an edge of the base are folded by 180 degrees less those of both of them.
TEST(SurfaceCheck, NamesAFold) {
  const auto height = [](double fold) {
    return std::tan((180 - fold) / 2 * std::numbers::pi / 180) / std::numbers::sqrt2;
  };
  const auto folded = [&](double fold) { return flaw_of(bipyramid(height(fold), -height(fold))); };
  EXPECT_EQ(folded(SurfaceCheck::greatest_fold_deg - 0.01), "");
  EXPECT_THAT(folded(161.5), AllOf(HasSubstr("at (0.5, 0.5, 0)"), HasSubstr("elements 0 and 4"),
                                   HasSubstr("edge of the nodes 0 and 1"), HasSubstr("161.5 degrees"),
                                   HasSubstr("at most 160 are allowed")));
  // The lower pyramid turned up into the upper one: they have the same angle, by the other sign.
  EXPECT_THAT(flaw_of(bipyramid(1, 0.9)), HasSubstr("folded up"));
}

// Sides of a high bipyramid are as wide as sqrt(2): over the longer edges sqrt(1 + z^2) their height is
// sqrt(2 z^2 + 1)/(1 + z^2).
TEST(SurfaceCheck, NamesANeedle) {
  const auto height = [](double z) { return std::sqrt(2 * z * z + 1) / (1 + z * z); };
  ASSERT_GT(height(70), SurfaceCheck::least_height);
  ASSERT_LT(height(72), SurfaceCheck::least_height);
  EXPECT_EQ(flaw_of(bipyramid(70, -70)), "");
  EXPECT_THAT(flaw_of(bipyramid(72, -70)),
              AllOf(HasSubstr("element 0 (nodes 0, 1, 4)"), HasSubstr("needle"), HasSubstr("0.0196")));
}

TEST(SurfaceCheck, NamesWhatIsNoTriangle) {
  auto mesh = bipyramid(1, -1);
  mesh.points.col(5) = mesh.points.col(0);
  EXPECT_THAT(flaw_of(mesh), HasSubstr("element 4"));
  mesh = bipyramid(1, -1);
  mesh.points(2, 5) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(flaw_of(mesh), AllOf(HasSubstr("element 4 (nodes 1, 0, 5)"), HasSubstr("not finite")));
}

}  // namespace
}  // namespace tanktread::membrane::surface_check_test
