// The bending energy of smooth closed surfaces: of second order in the size of the triangles.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "unit/membrane_energy_list.hpp"

namespace tanktread::membrane::test::energy_order_test {
namespace {

constexpr double pi = std::numbers::pi;

/// Relative errors of the energy with kappa_b = 1 on the levels from `first` to 5 of a sphere of radius 1
/// that is mapped onto the surface.
std::vector<double> errors(int first, double spontaneous_curvature, double exact,
                           const std::function<Eigen::Vector3d(const Eigen::Vector3d&)>& mapped) {
  std::vector<double> errors;
  for (int level = first; level <= 5; ++level) {
    auto mesh = icosphere(level, 1);
    for (Eigen::Index node = 0; node < mesh.points.cols(); ++node)
      mesh.points.col(node) = mapped(mesh.points.col(node));
    EnergyTerms terms(
        mesh, {{"bending", {{"bending_modulus", 1}, {"spontaneous_curvature", spontaneous_curvature}}}}, 1);
    errors.push_back(terms.energy(mesh.points) / exact - 1);
  }
  return errors;
}

/// Each level halves the edges: the error is a fourth, with terms of the fourth order besides that are some
/// h^2 of it, below a tenth of the order from the coarsest level on.
void expect_second_order(const std::vector<double>& errors) {
  for (std::size_t k = 1; k < errors.size(); ++k) {
    const double order = std::log2(errors[k - 1] / errors[k]);
    EXPECT_GT(order, 1.9) << errors[k - 1] << " " << errors[k];
    EXPECT_LT(order, 2.1) << errors[k - 1] << " " << errors[k];
  }
}

TEST(BendingOrder, OfASphereIsEightPiTimesTheModulus) {
  const double radius = 2;
  const auto of_sphere = errors(2, 0, 8 * pi, [&](const Eigen::Vector3d& x) { return radius * x; });
  expect_second_order(of_sphere);
  EXPECT_LT(std::abs(of_sphere.back()), 2e-4);
}

// (kappa_b/2) (2/R - c_0)^2 4 pi R^2, with curvatures that the sphere is too curved, too flat and of the
// other sign for.
TEST(BendingOrder, OfASphereWithSpontaneousCurvature) {
  const double radius = 2;
  for (const double curvature : {0.5, 2.0, -1.0}) {
    const double exact = 8 * pi * std::pow(1 - curvature * radius / 2, 2);
    const auto of_sphere = errors(2, curvature, exact, [&](const Eigen::Vector3d& x) { return radius * x; });
    expect_second_order(of_sphere);
    EXPECT_LT(std::abs(of_sphere.back()), 1e-3);
  }
}

// Semi-axes a along z, b across, a > b. With u = cos t, z = a u, r = b sin t and W^2 = a^2 - c^2 u^2, c^2 =
// a^2 - b^2, the principal curvatures are a b/W^3 and a/(b W), and dA = 2 pi b W du. The integrals of 1/W^5,
// 1/W^3 and 1/W over [-1, 1] are elementary.
TEST(BendingOrder, OfAProlateSpheroid) {
  const double a = 1.5, b = 1, c = std::sqrt(a * a - b * b);
  const double exact = pi * (14.0 / 3 + 4 * b * b / (3 * a * a) + 2 * a * a * std::asin(c / a) / (b * c));
  const auto of_spheroid = errors(
      2, 0, exact, [&](const Eigen::Vector3d& x) { return Eigen::Vector3d(b * x[0], b * x[1], a * x[2]); });
  expect_second_order(of_spheroid);
  EXPECT_LT(std::abs(of_spheroid.back()), 2e-4);
}

/// The cell of Evans and Fung 1972 in micrometres: at the distance 3.91 sin t from the axis it reaches up to
/// cos t (0.81 + 7.83 sin^2 t - 4.39 sin^4 t)/2.
constexpr double cell_radius = 3.91;
double half_thickness_by_cosine(double s) {
  return 0.5 * (0.81 + 7.83 * s * s - 4.39 * s * s * s * s);
}

/// (1/2) integral of (2 H)^2 dA of the cell: with r(t), z(t) of its outline the curvatures are
/// (z' r'' - r' z'')/w^3 along it and -z'/(r w) about the axis, w^2 = r'^2 + z'^2. By Simpson's rule on a
/// function that is smooth and even about both ends.
double bending_energy_of_cell() {
  const auto integrand = [](double t) {
    const double s = std::sin(t), c = std::cos(t);
    // z = c p(s), p' = dp/ds.
    const double p = half_thickness_by_cosine(s), p1 = 7.83 * s - 8.78 * s * s * s, p2 = 7.83 - 26.34 * s * s;
    const double r1 = cell_radius * c, r2 = -cell_radius * s;
    const double z1 = -s * p + c * c * p1, z2 = -c * p - 3 * s * c * p1 + c * c * c * p2;
    const double w = std::hypot(r1, z1);
    const double along = (z1 * r2 - r1 * z2) / (w * w * w);
    const double about = s == 0 ? along : -z1 / (cell_radius * s * w);
    return 0.5 * std::pow(along + about, 2) * 2 * pi * cell_radius * s * w;
  };
  const int n = 2000;
  const double step = pi / 2 / n;  // both halves are alike
  double sum = integrand(0) + integrand(pi / 2);
  for (int k = 1; k < n; ++k) sum += (k % 2 == 1 ? 4 : 2) * integrand(k * step);
  return 2 * sum * step / 3;
}

// The outline is flat in the middle and bent at the rim, and a mapped sphere has its triangles where they
// are, so the coarsest meshes are not yet of an order.
TEST(BendingOrder, OfARedCell) {
  const double exact = bending_energy_of_cell();
  EXPECT_NEAR(exact / (8 * pi), 1.92874, 5e-6);
  const auto of_cell = errors(3, 0, exact, [](const Eigen::Vector3d& x) {
    const double s = std::hypot(x[0], x[1]);
    return Eigen::Vector3d(cell_radius * x[0], cell_radius * x[1], x[2] * half_thickness_by_cosine(s));
  });
  expect_second_order(of_cell);
  EXPECT_LT(std::abs(of_cell.back()), 1e-3);
}

// The work of the forces in a growth is -R dE/dR = 8 pi kappa_b c_0 R (1 - c_0 R/2) of the smooth sphere.
TEST(BendingOrder, OfTheWorkOfASphereThatGrows) {
  const double radius = 2, curvature = 0.4;
  std::vector<double> errors;
  for (int level = 2; level <= 5; ++level) {
    const auto sphere = icosphere(level, radius);
    EnergyTerms terms(sphere, {{"bending", {{"bending_modulus", 1}, {"spontaneous_curvature", curvature}}}},
                      1);
    const double work = forces(terms, sphere.points).cwiseProduct(sphere.points).sum();
    errors.push_back(work / (8 * pi * curvature * radius * (1 - curvature * radius / 2)) - 1);
  }
  expect_second_order(errors);
}

}  // namespace
}  // namespace tanktread::membrane::test::energy_order_test
