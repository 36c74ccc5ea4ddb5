// Bodies of revolution by their meridians: the numbers of the red cell, spheroids against closed forms.
#include "membrane/meridian.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "unit/membrane_support.hpp"

namespace tanktread::membrane::test {
namespace {

using std::numbers::pi;

// A sum of 128 panels of positive numbers rounds by half an epsilon each at most.
constexpr double quadrature_rounding = 128 * epsilon;

TEST(Meridian, OfTheRedCellHasThePublishedNumbers) {
  const auto unit = biconcave_meridian(1);
  const double micrometre = 3.91 / unit.rim;  // also the radius of the sphere of its volume
  EXPECT_NEAR(micrometre, 2.8215, 5e-5);
  EXPECT_NEAR(volume(unit) * std::pow(micrometre, 3), 94.09, 5e-3);
  EXPECT_NEAR(surface_area(unit) * std::pow(micrometre, 2), 134.09, 5e-3);
  EXPECT_NEAR(reduced_volume(unit), 0.6444, 5e-5);
  EXPECT_NEAR(2 * point_at(unit, 0).z * micrometre, 0.81, 10 * epsilon);
  double thickest = 0;
  for (int k = 0; k <= 1000; ++k) thickest = std::max(thickest, 2 * point_at(unit, 0.5 * pi * k / 1000).z);
  EXPECT_NEAR(thickest * micrometre, 2.566, 5e-4);
}

TEST(Meridian, HasTheVolumeOfTheSphereOfItsRadius) {
  for (const double radius : {0.3, 1.0, 19.1}) {
    const double sphere = 4 * pi / 3 * std::pow(radius, 3), rounding = 20 * epsilon * sphere;
    EXPECT_NEAR(volume(biconcave_meridian(radius)), sphere, rounding);
    for (const double ratio : {0.1, 0.5, 1.0, 2.0, 10.0}) {
      const auto spheroid = spheroid_meridian(radius, ratio);
      EXPECT_NEAR(volume(spheroid), sphere, rounding);
      EXPECT_NEAR(spheroid.heights[0] / spheroid.rim, ratio, 2 * epsilon * ratio);
    }
  }
}

/// Of the spheroid of semi-axes 1, 1, r.
double area_in_closed_form(double r) {
  if (r == 1) return 4 * pi;
  if (r < 1) {
    const double e = std::sqrt(1 - r * r);
    return 2 * pi * (1 + r * r / e * std::atanh(e));
  }
  const double e = std::sqrt(1 - 1 / (r * r));
  return 2 * pi * (1 + r / e * std::asin(e));
}

TEST(Meridian, OfASpheroidHasItsAreaInClosedForm) {
  for (const double ratio : {0.1, 0.15, 0.3, 0.7, 1.0, 1.5, 4.0, 10.0}) {
    const double exact = area_in_closed_form(ratio);
    EXPECT_NEAR(surface_area(Meridian{1, {ratio, 0, 0}}), exact, quadrature_rounding * exact) << ratio;
  }
}

TEST(Meridian, OfASpheroidOfAReducedVolumeHasIt) {
  for (const double wanted : {0.5, 0.65, 0.8, 0.95, 0.999, 1.0}) {
    const double oblate = spheroid_aspect_ratio(wanted, Spheroid::oblate),
                 prolate = spheroid_aspect_ratio(wanted, Spheroid::prolate);
    EXPECT_TRUE(wanted == 1 ? oblate == 1 && prolate == 1 : oblate < 1 && prolate > 1) << wanted;
    for (const double ratio : {oblate, prolate}) {
      // V/A^(3/2): the area rounds as above, and comes in with the power 3/2.
      const double found =
          (4 * pi / 3 * ratio) / (4 * pi / 3 * std::pow(area_in_closed_form(ratio) / (4 * pi), 1.5));
      EXPECT_NEAR(found, wanted, 2 * quadrature_rounding) << ratio;
    }
  }
}

// From the pole the length of an oblate spheroid's meridian is the elliptic integral E(t, e).
TEST(MeridianLength, OfAnEllipseIsTheEllipticIntegral) {
  for (const double ratio : {0.1, 0.5, 0.99}) {
    const double e = std::sqrt(1 - ratio * ratio), whole = std::comp_ellint_2(e);
    const MeridianLength length(Meridian{1, {ratio, 0, 0}});
    EXPECT_NEAR(length.total(), whole, quadrature_rounding * whole);
    for (const double share : {0.0, 1e-3, 0.25, 0.5, 0.77, 0.999, 1.0})
      EXPECT_NEAR(std::ellint_2(e, length.parameter_at(share)), share * whole,
                  2 * quadrature_rounding * whole)
          << share;
  }
}

TEST(Meridian, RefusesWhatIsOutOfRange) {
  const double infinite = std::numeric_limits<double>::infinity(),
               none = std::numeric_limits<double>::quiet_NaN();
  for (const double radius : {0.0, -1.0, infinite, none}) {
    EXPECT_THROW(biconcave_meridian(radius), std::invalid_argument);
    EXPECT_THROW(spheroid_meridian(radius, 1), std::invalid_argument);
  }
  for (const double ratio : {0.0, 0.0999, 10.1, none})
    EXPECT_THROW(spheroid_meridian(1, ratio), std::invalid_argument);
  for (const double wanted : {0.4999, 1.0001, none})
    EXPECT_THROW(spheroid_aspect_ratio(wanted, Spheroid::prolate), std::invalid_argument);
}

}  // namespace
}  // namespace tanktread::membrane::test
