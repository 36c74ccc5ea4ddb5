// Membrane viscosity as an operator: rigid motions, its transpose, power, threads, refusals. (Exact rates,
// and the law that it stands for: verification/membrane_strain_rates_exact_test.cpp)
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "unit/membrane_strain_rates_support.hpp"

namespace tanktread::membrane::test {
namespace {

double dot(const Eigen::Matrix3Xd& a, const Eigen::Matrix3Xd& b) {
  return a.cwiseProduct(b).sum();
}

/// Components of size 1 without any order.
Eigen::Matrix3Xd random_vectors(Eigen::Index n, unsigned seed) {
  return randomly_moved(Eigen::Matrix3Xd::Zero(3, n), 1, seed);
}

INSTANTIATE_TEST_SUITE_P(Both, StrainRatesAt, testing::Values(RatesAt::elements, RatesAt::nodes), name_of);

TEST_P(StrainRatesAt, OfATranslationAreExactlyZero) {
  const auto mesh = deformed_sphere(2);
  const Eigen::Matrix3Xd velocity = Eigen::Vector3d(0.3, -7, 1e6).replicate(1, mesh.points.cols());
  EXPECT_EQ(product(at(mesh, GetParam()), velocity).cwiseAbs().maxCoeff(), 0);
}

TEST_P(StrainRatesAt, OfARotationAreZero) {
  const auto mesh = deformed_sphere(2);
  const Eigen::Vector3d spin(0.7, -1.1, 0.4);
  Eigen::Matrix3Xd velocity = mesh.points;
  for (auto node : velocity.colwise()) node = spin.cross(Eigen::Vector3d(node));
  EXPECT_LT(product(at(mesh, GetParam()), velocity).cwiseAbs().maxCoeff(),
            rate_rounding(mesh, spin.norm(), GetParam()));
}

TEST_P(StrainRatesAt, TurnWithTheSurface) {
  // The same shape and the same velocities, turned: the same numbers, but for the rounding of the turned
  // positions, which is that of velocities (three more roundings, of a gradient below 1.5), twice.
  const auto mesh = deformed_sphere(2);
  const Eigen::Matrix3d r = rotation({1, 2, -1}, 1.3);
  auto turned = mesh;
  turned.points = r * mesh.points;
  Eigen::Matrix3d flow;
  flow << 0.3, 0.5, -0.2, 0.1, -0.4, 0.3, 0.2, -0.1, 0.6;
  const Eigen::Matrix3Xd velocity = flow * mesh.points, expected = product(at(mesh, GetParam()), velocity);
  ASSERT_GT(expected.colwise().norm().minCoeff(), 0.01);
  EXPECT_LT((product(at(turned, GetParam()), r * velocity) - expected).cwiseAbs().maxCoeff(),
            4 * rate_rounding(mesh, 1.5, GetParam()));
}

// A sum of n products in any order is off by n epsilon/2 times the sum of their sizes; a factor that is
// itself a sum of a dozen products, and at nodes of 18 of such, without much cancellation adds 40 to n.
double dot_rounding(const Eigen::Matrix3Xd& a, const Eigen::Matrix3Xd& b) {
  return (a.size() + 40) * epsilon / 2 * a.cwiseProduct(b).cwiseAbs().sum();
}

TEST_P(StrainRatesAt, TheTransposeIsTheTranspose) {
  const auto mesh = deformed_sphere(2);
  const auto rates = at(mesh, GetParam());
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const auto u = random_vectors(rates.n_nodes(), seed), s = random_vectors(rates.n_rates(), seed + 10);
    const auto of_u = product(rates, u), of_s = transposed_product(rates, s);
    EXPECT_NEAR(dot(of_u, s), dot(u, of_s), dot_rounding(of_u, s) + dot_rounding(u, of_s));
  }
}

TEST_P(StrainRatesAt, WithTheirTransposeAreSymmetricAndPositive) {
  const auto mesh = deformed_sphere(2);
  const auto rates = at(mesh, GetParam());
  const auto u = random_vectors(rates.n_nodes(), 1), v = random_vectors(rates.n_nodes(), 2);
  const auto of_u = transposed_product(rates, product(rates, u));
  const auto of_v = transposed_product(rates, product(rates, v));
  EXPECT_NEAR(dot(v, of_u), dot(u, of_v), dot_rounding(v, of_u) + dot_rounding(u, of_v));
  EXPECT_GT(dot(u, of_u), 0.1 * of_u.norm() * u.norm());
  // Even for the smoothest of the velocities that strain it.
  const Eigen::Matrix3Xd smooth = mesh.points;
  EXPECT_GT(dot(smooth, transposed_product(rates, product(rates, smooth))), 1);
}

TEST_P(StrainRatesAt, PowerOfTheForceIsTheDissipationOfTheStress) {
  // -F.u = |B u|^2 = sum A_t stress_t : D_t over the elements: at nodes too, for the mean that makes the
  // stress of an element is the transpose of the one that makes the rates of a node.
  const auto mesh = deformed_sphere(2);
  const auto rates = at(mesh, GetParam());
  const auto velocity = smooth_velocity(mesh.points);
  const auto stress = rates.stress(product(rates, velocity));
  const auto area = areas(mesh);
  double dissipation = 0;
  for (Eigen::Index t = 0; t < rates.n_elements(); ++t)
    dissipation += area[t] * tensor(stress, t).cwiseProduct(rate_of_deformation(mesh, velocity, t)).sum();
  const Eigen::Matrix3Xd of_u = product(rates, velocity), force = -transposed_product(rates, of_u);
  ASSERT_GT(dissipation, 1);
  // Of each of the three sums as above; r = gradient_rounding() is the relative rounding of a rate, of axes
  // and of what is made of them.
  const double bound = 2 * dot_rounding(of_u, of_u) + dot_rounding(force, velocity) +
                       8 * gradient_rounding(mesh, mesh.points) * dissipation;
  EXPECT_NEAR(of_u.squaredNorm(), dissipation, bound);
  EXPECT_NEAR(-dot(force, velocity), dissipation, bound);
}

TEST(StrainRates, OfElementsHaveTheStressOfBoussinesqAndScriven) {
  const auto mesh = deformed_sphere(2);
  const auto rates = at(mesh, RatesAt::elements);
  const auto velocity = smooth_velocity(mesh.points);
  const auto stress = rates.stress(product(rates, velocity));
  // A rate is below 3 and off as in rate_rounding(), without the root of the area; the axes of the tensor add
  // r twice, and this side as much again.
  const double bound = 2 * (3.2 + 2) * 3 * 2 * mu_d * gradient_rounding(mesh, mesh.points);
  for (Eigen::Index t = 0; t < rates.n_elements(); ++t) {
    const auto element = reference_element(corners_of(mesh.points, mesh.triangles.col(t)));
    const auto axes = deformation_gradient(corners_of(mesh.points, mesh.triangles.col(t)), element);
    const auto expected = viscous_tension(rate_of_deformation(mesh, velocity, t), axes * axes.transpose());
    EXPECT_LT((tensor(stress, t) - expected).cwiseAbs().maxCoeff(), bound);
  }
}

TEST_P(StrainRatesAt, DoNotDependOnTheNumberOfThreads) {
  const auto mesh = deformed_sphere(3);
  const auto velocity = smooth_velocity(mesh.points);
  const auto where = GetParam();
  const auto one = at(mesh, where), two = at(mesh, where, mu_s, mu_d, 2),
             three = at(mesh, where, mu_s, mu_d, 3);
  const auto expected = product(one, velocity);
  const auto force = transposed_product(one, expected);
  const auto stress = one.stress(expected);
  for (const auto* many : {&two, &three}) {
    EXPECT_TRUE(same_bits(product(*many, velocity), expected));
    EXPECT_TRUE(same_bits(transposed_product(*many, expected), force));
    EXPECT_TRUE(same_bits(many->stress(expected), stress));
  }
}

/// Velocities, a basis of them, whose B u is zero to rounding.
Eigen::Index n_unseen(const StrainRates& rates) {
  Eigen::MatrixXd matrix(3 * rates.n_rates(), 3 * rates.n_nodes());
  for (Eigen::Index k = 0; k < matrix.cols(); ++k) {
    Eigen::Matrix3Xd unit = Eigen::Matrix3Xd::Zero(3, rates.n_nodes());
    unit.data()[k] = 1;
    matrix.col(k) = product(rates, unit).reshaped();
  }
  Eigen::FullPivLU<Eigen::MatrixXd> eliminated(matrix);
  eliminated.setThreshold(1e-9);
  return eliminated.dimensionOfKernel();
}

// What the header says of short waves: the rounding of a singular value is some 10^-15 of the largest, the
// least other one some 10^-3.
TEST(StrainRates, AtNodesDoNotSeeSixShortWavesOfAnIcosphere) {
  const auto sphere = icosphere(1, 1), deformed = deformed_sphere(1);
  EXPECT_EQ(n_unseen(at(sphere, RatesAt::elements)), 6);
  EXPECT_EQ(n_unseen(at(sphere, RatesAt::nodes)), 6 + 6);
  EXPECT_EQ(n_unseen(at(deformed, RatesAt::nodes)), 6);
  // Without dilatational viscosity: the rigid ones included, the number of nodes, and on triangles swelling.
  EXPECT_EQ(n_unseen(at(deformed, RatesAt::nodes, mu_s, 0)), deformed.points.cols());
  EXPECT_EQ(n_unseen(at(deformed, RatesAt::elements, mu_s, 0)), 6 + 1);
}

template <typename Error, typename Action>
std::string message_of(Action action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "nothing was thrown";
}

TEST_P(StrainRatesAt, RefuseWhatTheyCannotUse) {
  using Refused = std::invalid_argument;
  const auto sphere = icosphere(1, 1);
  const auto n = sphere.points.cols();
  const auto& t = sphere.triangles;
  const auto made = [&](Eigen::Index n_nodes, double shear, double dilatational, int threads) {
    return message_of<Refused>([&] { StrainRates(t, n_nodes, shear, dilatational, GetParam(), threads); });
  };
  EXPECT_EQ(made(n, 1, 0, 1), "nothing was thrown");
  EXPECT_THAT(made(n - 1, 1, 1, 1), testing::HasSubstr("names node " + std::to_string(n - 1)));
  EXPECT_THAT(made(n, -1, 1, 1), testing::HasSubstr("shear_viscosity is -1"));
  EXPECT_THAT(made(n, 1, std::nan(""), 1), testing::HasSubstr("dilatational_viscosity is"));
  EXPECT_THAT(made(n, 1, 1, -1), testing::HasSubstr("threads = -1"));
  const bool at_nodes = GetParam() == RatesAt::nodes;
  EXPECT_THAT(made(n + 1, 1, 1, 1),
              testing::HasSubstr(at_nodes ? "node " + std::to_string(n) + " has no triangle" : "nothing"));

  StrainRates rates(t, n, 1, 1, GetParam(), 1);
  Eigen::Matrix3Xd of_nodes = sphere.points, of_rates(3, rates.n_rates()), wrong(3, n + 1);
  EXPECT_EQ(rates.n_rates(), at_nodes ? n : t.cols());
  EXPECT_THROW(rates.multiply(of_nodes, of_rates), std::logic_error);
  EXPECT_THROW(rates.multiply_transposed(of_rates, of_nodes), std::logic_error);
  EXPECT_THROW(rates.stress(of_rates), std::logic_error);
  EXPECT_THROW(rates.set_positions(wrong), Refused);
  rates.set_positions(sphere.points);
  EXPECT_THROW(rates.multiply(wrong, of_rates), Refused);
  EXPECT_THROW(rates.multiply(of_nodes, wrong), Refused);
  EXPECT_THROW(rates.multiply_transposed(wrong, of_nodes), Refused);
  EXPECT_THROW(rates.multiply_transposed(of_rates, wrong), Refused);
  EXPECT_THROW(rates.stress(wrong), Refused);
}

TEST_P(StrainRatesAt, NameAnElementWithoutAreaAndKeepThePositionsBefore) {
  const auto sphere = icosphere(1, 1);
  auto rates = at(sphere, GetParam());
  const auto expected = product(rates, sphere.points);
  const int lost_node = sphere.triangles(2, 7), kept_node = sphere.triangles(1, 7);
  const auto first_with = [&](std::initializer_list<int> nodes) {
    for (int t = 0;; ++t) {
      int n_found = 0;
      for (const int node : nodes) n_found += (sphere.triangles.col(t).array() == node).any();
      if (n_found == std::ssize(nodes)) return "element " + std::to_string(t) + " (nodes ";
    }
  };
  auto collapsed = sphere.points, lost = sphere.points;
  collapsed.col(lost_node) = collapsed.col(kept_node);
  lost(1, lost_node) = std::nan("");
  EXPECT_THAT(message_of<InvertedElement>([&] { rates.set_positions(collapsed); }),
              testing::StartsWith(first_with({lost_node, kept_node})));
  EXPECT_THAT(message_of<InvertedElement>([&] { rates.set_positions(lost); }),
              testing::StartsWith(first_with({lost_node})));
  EXPECT_TRUE(same_bits(product(rates, sphere.points), expected));
}

TEST(StrainRates, AtNodesNameANodeWithoutATangentPlane) {
  // Both sides of one triangle: normals cancel.
  TriangleMesh folded;
  folded.points = Eigen::Matrix3d::Identity();
  folded.triangles.resize(3, 2);
  folded.triangles << 0, 0, 1, 2, 2, 1;
  EXPECT_NO_THROW(at(folded, RatesAt::elements));
  const auto no_plane = testing::StartsWith("node 0 (of element 0) has no tangent plane");
  EXPECT_THAT(message_of<InvertedElement>([&] { at(folded, RatesAt::nodes); }), no_plane);

  // A pyramid on a square, its top straight above a corner: the first edge is along the mean normal.
  TriangleMesh pyramid;
  pyramid.points.resize(3, 5);
  pyramid.points << 0.1, 1, -1, -1, 1, 0, 1, 1, -1, -1, 1, 0, 0, 0, 0;
  pyramid.triangles.resize(3, 4);
  pyramid.triangles << 0, 0, 0, 0, 1, 2, 3, 4, 2, 3, 4, 1;
  auto rates = at(pyramid, RatesAt::nodes);
  const auto velocity = smooth_velocity(pyramid.points), expected = product(rates, velocity);
  pyramid.points.col(0) << 1, 1, 1;
  EXPECT_THAT(message_of<InvertedElement>([&] { rates.set_positions(pyramid.points); }), no_plane);
  EXPECT_TRUE(same_bits(product(rates, velocity), expected));
}

}  // namespace
}  // namespace tanktread::membrane::test
