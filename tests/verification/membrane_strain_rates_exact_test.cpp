// The strain-rate operator where its rates are known: a flat sheet, a sphere; and its force as the limit of
// the explicit viscous law.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "unit/membrane_strain_rates_support.hpp"
#include "unit/membrane_viscous_support.hpp"

namespace tanktread::membrane::test {
namespace {

/// A square of n x n cells of unequal triangles in the plane of x and y.
TriangleMesh flat_sheet(int n) {
  TriangleMesh sheet;
  sheet.points.resize(3, (n + 1) * (n + 1));
  sheet.triangles.resize(3, 2 * n * n);
  for (int k = 0; k < sheet.points.cols(); ++k) sheet.points.col(k) << k % (n + 1), k / (n + 1), 0;
  sheet.points = randomly_moved(sheet.points, 0.2, 4);
  sheet.points.row(2).setZero();
  for (int cell = 0; cell < n * n; ++cell) {
    const int corner = cell / n * (n + 1) + cell % n, above = corner + n + 1;
    sheet.triangles.col(2 * cell) << corner, corner + 1, above + 1;
    sheet.triangles.col(2 * cell + 1) << corner, above + 1, above;
  }
  return sheet;
}

TEST(StrainRates, OfAFlatSheetAreThoseOfItsFlow) {
  const int n = 6;
  const auto sheet = flat_sheet(n);
  const Eigen::Matrix3d to_space = rotation({1, -2, 0.5}, 0.9);
  auto tilted = sheet;
  tilted.points = to_space * sheet.points;
  const auto rates = at(tilted);
  struct Flow {
    std::string name;
    Eigen::Matrix3d gradient;
  };
  Eigen::Matrix3d shear, dilation, stretch, bending;
  shear << 0, 0.7, 0, 0, 0, 0, 0, 0, 0;
  dilation << 0.7, 0, 0, 0, 0.7, 0, 0, 0, 0;
  stretch << 0.7, 0, 0, 0, 0, 0, 0, 0, 0;
  bending << 0, 0, 0, 0, 0, 0, 0.7, -0.4, 0;  // out of the plane, linear: no strain
  for (const auto& [name, gradient] :
       {Flow{"simple shear", shear}, Flow{"dilation", dilation}, Flow{"stretch", stretch},
        Flow{"out of the plane", bending}, Flow{"all", shear + dilation + stretch + bending}}) {
    SCOPED_TRACE(name);
    const auto found = product(rates, to_space * gradient * sheet.points);
    const double difference = gradient(0, 0) - gradient(1, 1), twice = gradient(0, 1) + gradient(1, 0);
    const double trace = gradient(0, 0) + gradient(1, 1);
    // Norm of the gradient below 2; the tilt rounds positions and velocities three times more.
    const double bound = 4 * rate_rounding(tilted, 2);
    const Eigen::VectorXd area = areas(sheet);
    for (Eigen::Index t = 0; t < rates.n_elements(); ++t) {
      // D in axes that are turned by the angle of the first edge.
      const Eigen::Vector3d edge =
          sheet.points.col(sheet.triangles(1, t)) - sheet.points.col(sheet.triangles(0, t));
      const double angle = std::atan2(edge[1], edge[0]), c = std::cos(2 * angle), s = std::sin(2 * angle);
      EXPECT_NEAR(found(0, t), std::sqrt(mu_s * area[t]) * (c * difference + s * twice), bound);
      EXPECT_NEAR(found(1, t), std::sqrt(mu_s * area[t]) * (-s * difference + c * twice), bound);
      EXPECT_NEAR(found(2, t), std::sqrt(mu_d * area[t]) * trace, bound);
    }
    // A stress that is the same everywhere pulls at the rim alone: six corners, each with the rounding of a
    // rate times sqrt(mu A) grad N, below 2 sqrt(3), and of the sum itself.
    const auto force = transposed_product(rates, found);
    for (int node = 0; node < force.cols(); ++node) {
      const int i = node % (n + 1), j = node / (n + 1);
      if (i == 0 || j == 0 || i == n || j == n) continue;
      EXPECT_LT(force.col(node).norm(), 6 * 2 * std::sqrt(3.0) * 2 * bound) << node;
    }
  }
}

TEST(StrainRates, OfASwellingSphereAreThoseOfItsRadius) {
  // Every triangle grows evenly: D = (Udot/R) I, so tr D = 2 Udot/R, to rounding.
  const double radius = 5, growth = 0.3;
  const auto sphere = icosphere(2, radius);
  const auto found = product(at(sphere), growth / radius * sphere.points);
  const Eigen::VectorXd area = areas(sphere);
  const double bound = rate_rounding(sphere, growth / radius);
  for (Eigen::Index t = 0; t < found.cols(); ++t) {
    EXPECT_NEAR(found(0, t), 0, bound);
    EXPECT_NEAR(found(1, t), 0, bound);
    EXPECT_NEAR(found(2, t), std::sqrt(mu_d * area[t]) * 2 * growth / radius, bound);
  }
}

double order(double coarse, double fine) {
  return std::log2(std::abs(coarse / fine));
}

struct SphereFlow {
  std::string name;
  Eigen::Vector3d (*velocity)(const Eigen::Vector3d&);
  double shear, dilatation;  ///< exact powers over mu_s and mu_d, of a sphere of radius 1
};

// Powers on the sphere, integrated over the flat triangles of its mesh: of order 2 in their edge, by what the
// triangles lack in area and, with velocities that are not linear, by what a linear field lacks in its rates.
// From level 3 on (edges h = 0.15) the next term is h^2 of the error, times a number below 1: an order within
// log2((1 + h^2)/(1 + h^2/4)) = 0.025 of 2.
TEST(StrainRates, PowersOnASphereAreOfOrderTwo) {
  using std::numbers::pi;
  const std::vector<SphereFlow> flows = {
      // tr D = 2.
      {"swelling", [](const Eigen::Vector3d& x) -> Eigen::Vector3d { return x; }, 0, 4 * pi * 4},
      // u = (z, 0, 0): P E P with E : E = 1/2. The means over the sphere of E : E - 2 n E E n + (n E n)^2 and
      // (n E n)^2 are 7/15 and 2/15 of E : E; 2 D : D - (tr D)^2 has 4/5.
      {"simple shear", [](const Eigen::Vector3d& x) { return Eigen::Vector3d(x[2], 0, 0); }, 4 * pi * 2 / 5,
       4 * pi / 15},
      // Turning about z with the angular velocity z = cos t, t from the axis: 2 D12 = sin t d(cos t)/dt, its
      // square over the sphere 2 pi times the integral of sin^5 t, which is 16/15.
      {"twist", [](const Eigen::Vector3d& x) { return Eigen::Vector3d(-x[1] * x[2], x[0] * x[2], 0); },
       32 * pi / 15, 0},
  };
  for (const auto& flow : flows) {
    SCOPED_TRACE(flow.name);
    double shear_error[3], dilatation_error[3];
    for (int k = 0; k < 3; ++k) {
      const auto sphere = icosphere(3 + k, 1);
      Eigen::Matrix3Xd velocity = sphere.points;
      for (auto node : velocity.colwise()) node = flow.velocity(node);
      shear_error[k] = product(at(sphere, 1, 0, 2), velocity).squaredNorm() - flow.shear;
      dilatation_error[k] = product(at(sphere, 0, 1, 2), velocity).squaredNorm() - flow.dilatation;
    }
    const auto check = [&](const double* error, double exact) {
      EXPECT_LT(std::abs(error[2]), 0.001 * std::max(exact, 1.0));
      if (exact == 0) return;  // what is left is below that and perhaps of a higher order
      EXPECT_NEAR(order(error[0], error[1]), 2, 0.025);
      EXPECT_NEAR(order(error[1], error[2]), 2, 0.025 / 4);
    };
    check(shear_error, flow.shear);
    check(dilatation_error, flow.dilatation);
  }
}

// Flat triangles lock: a sphere whose nodes move by Y along the normal is dilated by 2 Y and not sheared, but
// a linear velocity on a flat triangle, whose nodes move along three normals, is sheared by what these
// differ, of the order of its edge. So there is a false power, of order 2, of 0.038 mu_s R^2 at level 3 with
// Y = x z/R^2 times a unit rate (docs/viscous-membranes.md). The next term as above, with a share of 0.05 for
// waves of Y.
TEST(StrainRates, MotionAlongTheNormalShearsFlatTrianglesFalsely) {
  double false_power[3], dilatation_error[3];
  for (int k = 0; k < 3; ++k) {
    const auto sphere = icosphere(3 + k, 1);
    Eigen::Matrix3Xd velocity = sphere.points;
    for (auto node : velocity.colwise()) node *= node[0] * node[2];
    false_power[k] = product(at(sphere, 1, 0, 2), velocity).squaredNorm();
    // The mean of x^2 z^2 over the sphere is 1/15.
    dilatation_error[k] =
        product(at(sphere, 0, 1, 2), velocity).squaredNorm() - 4 * std::numbers::pi * 4 / 15;
  }
  EXPECT_NEAR(false_power[0], 0.038, 0.001);
  for (const auto* error : {false_power, dilatation_error}) {
    EXPECT_NEAR(order(error[0], error[1]), 2, 0.05);
    EXPECT_NEAR(order(error[1], error[2]), 2, 0.05);
  }
}

// The law of elements without its springs. With a spring so stiff that exp(-k' dt/(2 mu)) is zero, int1 has
// the stress of the dashpot alone, 2 mu times the strain increment of the step. A step from x - h u to x: the
// viscous force over h is that of the rate half a step earlier, so it goes to -B^T B u with order 1 in h, and
// 2 F(h/2) - F(h) with order 2, down to the rounding epsilon/h of the increments.
TEST(StrainRates, TheForceIsTheLimitOfTheLawWithoutItsSprings) {
  const auto sphere = icosphere(2, 1);
  auto parameters = soft();
  parameters.scheme = "int1";
  parameters.shear_viscosity = mu_s;
  parameters.dilatational_viscosity = mu_d;
  parameters.shear_spring = parameters.dilatational_spring = 1e6;
  ASSERT_EQ(std::exp(-1e6 / (2 * std::max(mu_s, mu_d))), 0);
  TriangleMesh present = sphere;
  present.points = smoothly_deformed(sphere.points);
  const auto velocity = smooth_velocity(present.points);
  const auto rates = at(present);
  const Eigen::Matrix3Xd expected = -transposed_product(rates, product(rates, velocity));
  const auto force_after = [&](double h) -> Eigen::Matrix3Xd {
    auto membrane = viscous_membrane(sphere, parameters);
    viscous_forces(membrane, present.points - h * velocity);
    return viscous_forces(membrane, present.points) / h;
  };
  const double h = 1e-3;
  const Eigen::Matrix3Xd coarse = force_after(h), fine = force_after(h / 2), finest = force_after(h / 4);
  const auto error = [&](const Eigen::Matrix3Xd& force) {
    return (force - expected).norm() / expected.norm();
  };
  ASSERT_GT(expected.norm(), 1);
  // The rates of velocity and gradients are below 3, so that terms of the next order are below 3 h.
  EXPECT_LT(error(coarse), 3 * h);
  EXPECT_NEAR(order(error(coarse), error(fine)), 1, 3 * h);
  EXPECT_LT(error(2 * fine - coarse), 9 * h * h);
  EXPECT_NEAR(order(error(2 * fine - coarse), error(2 * finest - fine)), 2, 3 * h);
}

}  // namespace
}  // namespace tanktread::membrane::test
