// The strain-rate operator where its rates are known to rounding; and its force as the limit of the explicit
// viscous law. (On a sphere, with orders: membrane_strain_rates_order_test.cpp)
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "unit/membrane_strain_rates_support.hpp"
#include "unit/membrane_viscous_support.hpp"

namespace tanktread::membrane::test::strain_rates_exact_test {
namespace {

class StrainRatesExactAt : public StrainRatesAt {};

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

/// Where a column of rates belongs: an area, and the edge that axis 1 is along on a flat sheet.
struct Place {
  double area = 0;
  int from = -1, to = -1;
};

std::vector<Place> places_of_rates(const TriangleMesh& mesh, RatesAt where) {
  const bool at_nodes = where == RatesAt::nodes;
  std::vector<Place> places(at_nodes ? mesh.points.cols() : mesh.triangles.cols());
  const auto area = areas(mesh);
  for (Eigen::Index t = 0; t < mesh.triangles.cols(); ++t) {
    const auto nodes = mesh.triangles.col(t);
    if (!at_nodes) places[t] = {area[t], nodes[0], nodes[1]};
    for (int corner = 0; at_nodes && corner < 3; ++corner) {
      Place& place = places[nodes[corner]];
      if (place.from < 0) place = {0, nodes[corner], nodes[(corner + 1) % 3]};
      place.area += area[t] / 3;
    }
  }
  return places;
}

INSTANTIATE_TEST_SUITE_P(Both, StrainRatesExactAt, testing::Values(RatesAt::elements, RatesAt::nodes),
                         name_of);

TEST_P(StrainRatesExactAt, OfAFlatSheetAreThoseOfItsFlow) {
  const int n = 6;
  const auto sheet = flat_sheet(n);
  const Eigen::Matrix3d to_space = rotation({1, -2, 0.5}, 0.9);
  auto tilted = sheet;
  tilted.points = to_space * sheet.points;
  const auto rates = at(tilted, GetParam());
  const auto places = places_of_rates(sheet, GetParam());
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
    const double bound = 4 * rate_rounding(tilted, 2, GetParam());
    for (Eigen::Index k = 0; k < rates.n_rates(); ++k) {
      // D in axes that are turned by the angle of the edge.
      const Eigen::Vector3d edge = sheet.points.col(places[k].to) - sheet.points.col(places[k].from);
      const double angle = std::atan2(edge[1], edge[0]), c = std::cos(2 * angle), s = std::sin(2 * angle);
      const double shear_root = std::sqrt(mu_s * places[k].area);
      EXPECT_NEAR(found(0, k), shear_root * (c * difference + s * twice), bound);
      EXPECT_NEAR(found(1, k), shear_root * (-s * difference + c * twice), bound);
      EXPECT_NEAR(found(2, k), std::sqrt(mu_d * places[k].area) * trace, bound);
    }
    Eigen::Matrix3d d = 0.5 * (gradient + gradient.transpose()), plane = Eigen::Matrix3d::Identity();
    d.row(2).setZero(), d.col(2).setZero(), plane(2, 2) = 0;
    const Eigen::Matrix3d tension = to_space * viscous_tension(d, plane) * to_space.transpose();
    // As a rate, without the root of the smallest area and with that of the viscosity once more, on two axes.
    const double smallest = areas(sheet).minCoeff() / 3;
    const auto stress = rates.stress(found);
    for (Eigen::Index t = 0; t < rates.n_elements(); ++t) {
      EXPECT_LT((tensor(stress, t) - tension).cwiseAbs().maxCoeff(), 4 * bound * std::sqrt(mu_d / smallest));
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

TEST(StrainRates, OfElementsOfASwellingSphereAreThoseOfItsRadius) {
  // Every triangle grows evenly: D = (Udot/R) I, so tr D = 2 Udot/R, to rounding.
  const double radius = 5, growth = 0.3;
  const auto sphere = icosphere(2, radius);
  const auto found = product(at(sphere, RatesAt::elements), growth / radius * sphere.points);
  const Eigen::VectorXd area = areas(sphere);
  const double bound = rate_rounding(sphere, growth / radius, RatesAt::elements);
  for (Eigen::Index t = 0; t < found.cols(); ++t) {
    EXPECT_NEAR(found(0, t), 0, bound);
    EXPECT_NEAR(found(1, t), 0, bound);
    EXPECT_NEAR(found(2, t), std::sqrt(mu_d * area[t]) * 2 * growth / radius, bound);
  }
}

double order(double coarse, double fine) {
  return std::log2(std::abs(coarse / fine));
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
  const auto rates = at(present, RatesAt::elements);
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
}  // namespace tanktread::membrane::test::strain_rates_exact_test
