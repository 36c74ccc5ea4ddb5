// Membrane viscosity as an operator: rigid motions, its transpose, power, threads, refusals. (Exact rates,
// and the law that it stands for: verification/membrane_strain_rates_exact_test.cpp)
#include <gmock/gmock.h>
#include <gtest/gtest.h>

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

TEST(StrainRates, OfATranslationAreExactlyZero) {
  const auto mesh = deformed_sphere(2);
  const Eigen::Matrix3Xd velocity = Eigen::Vector3d(0.3, -7, 1e6).replicate(1, mesh.points.cols());
  EXPECT_EQ(product(at(mesh), velocity).cwiseAbs().maxCoeff(), 0);
}

TEST(StrainRates, OfARotationAreZero) {
  const auto mesh = deformed_sphere(2);
  const Eigen::Vector3d spin(0.7, -1.1, 0.4);
  Eigen::Matrix3Xd velocity = mesh.points;
  for (auto node : velocity.colwise()) node = spin.cross(Eigen::Vector3d(node));
  EXPECT_LT(product(at(mesh), velocity).cwiseAbs().maxCoeff(), rate_rounding(mesh, spin.norm()));
}

TEST(StrainRates, TurnWithTheElement) {
  // The same shape and the same velocities, turned: the same numbers, but for the rounding of the turned
  // positions, which is that of velocities (three more roundings, of a gradient below 1.5), twice.
  const auto mesh = deformed_sphere(2);
  const Eigen::Matrix3d r = rotation({1, 2, -1}, 1.3);
  auto turned = mesh;
  turned.points = r * mesh.points;
  Eigen::Matrix3d flow;
  flow << 0.3, 0.5, -0.2, 0.1, -0.4, 0.3, 0.2, -0.1, 0.6;
  const Eigen::Matrix3Xd velocity = flow * mesh.points, expected = product(at(mesh), velocity);
  ASSERT_GT(expected.colwise().norm().minCoeff(), 0.01);
  EXPECT_LT((product(at(turned), r * velocity) - expected).cwiseAbs().maxCoeff(),
            4 * rate_rounding(mesh, 1.5));
}

// A sum of n products in any order is off by n epsilon/2 times the sum of their sizes; a factor that is
// itself a sum of a dozen products without much cancellation adds 20 to n.
double dot_rounding(const Eigen::Matrix3Xd& a, const Eigen::Matrix3Xd& b) {
  return (a.size() + 20) * epsilon / 2 * a.cwiseProduct(b).cwiseAbs().sum();
}

TEST(StrainRates, TheTransposeIsTheTranspose) {
  const auto mesh = deformed_sphere(2);
  const auto rates = at(mesh);
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const auto u = random_vectors(rates.n_nodes(), seed), s = random_vectors(rates.n_elements(), seed + 10);
    const auto of_u = product(rates, u), of_s = transposed_product(rates, s);
    EXPECT_NEAR(dot(of_u, s), dot(u, of_s), dot_rounding(of_u, s) + dot_rounding(u, of_s));
  }
}

TEST(StrainRates, WithTheirTransposeAreSymmetricAndPositive) {
  const auto mesh = deformed_sphere(2);
  const auto rates = at(mesh);
  const auto u = random_vectors(rates.n_nodes(), 1), v = random_vectors(rates.n_nodes(), 2);
  const auto of_u = transposed_product(rates, product(rates, u));
  const auto of_v = transposed_product(rates, product(rates, v));
  EXPECT_NEAR(dot(v, of_u), dot(u, of_v), dot_rounding(v, of_u) + dot_rounding(u, of_v));
  EXPECT_GT(dot(u, of_u), 0.1 * of_u.norm() * u.norm());
  // Even for the smoothest of the velocities that strain it.
  const Eigen::Matrix3Xd smooth = mesh.points;
  EXPECT_GT(dot(smooth, transposed_product(rates, product(rates, smooth))), 1);
}

TEST(StrainRates, PowerOfTheForceIsTheDissipationOfTheStress) {
  // -F.u = sum A tau_v : D, with tau_v = mu_s (2 D - tr(D) I) + mu_d tr(D) I and D in space: the symmetric
  // part of the velocity gradient between projections on the plane of the element.
  const auto mesh = deformed_sphere(2);
  const auto rates = at(mesh);
  const auto velocity = smooth_velocity(mesh.points);
  double dissipation = 0;
  for (Eigen::Index t = 0; t < rates.n_elements(); ++t) {
    const Eigen::Vector3i nodes = mesh.triangles.col(t);
    const auto element = reference_element(corners_of(mesh.points, nodes));
    const SurfaceGradient axes = deformation_gradient(corners_of(mesh.points, nodes), element);
    const Eigen::Matrix3d gradient = axes * axes.transpose() *
                                     deformation_gradient(corners_of(velocity, nodes), element) *
                                     axes.transpose();
    const Eigen::Matrix3d d = 0.5 * (gradient + gradient.transpose()), plane = axes * axes.transpose();
    const Eigen::Matrix3d stress = mu_s * (2 * d - d.trace() * plane) + mu_d * d.trace() * plane;
    dissipation += element.area * stress.cwiseProduct(d).sum();
  }
  const Eigen::Matrix3Xd of_u = product(rates, velocity), force = -transposed_product(rates, of_u);
  ASSERT_GT(dissipation, 1);
  // Of each of the three sums as above; r = gradient_rounding() is the relative rounding of a rate.
  const double bound = 2 * dot_rounding(of_u, of_u) + dot_rounding(force, velocity) +
                       8 * gradient_rounding(mesh, mesh.points) * dissipation;
  EXPECT_NEAR(of_u.squaredNorm(), dissipation, bound);
  EXPECT_NEAR(-dot(force, velocity), dissipation, bound);
}

TEST(StrainRates, DoNotDependOnTheNumberOfThreads) {
  const auto mesh = deformed_sphere(3);
  const auto velocity = smooth_velocity(mesh.points);
  const auto one = at(mesh), two = at(mesh, mu_s, mu_d, 2), three = at(mesh, mu_s, mu_d, 3);
  const auto expected = product(one, velocity);
  const auto force = transposed_product(one, expected);
  for (const auto* many : {&two, &three}) {
    EXPECT_TRUE(same_bits(product(*many, velocity), expected));
    EXPECT_TRUE(same_bits(transposed_product(*many, expected), force));
  }
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

TEST(StrainRates, RefuseWhatTheyCannotUse) {
  using Refused = std::invalid_argument;
  const auto sphere = icosphere(1, 1);
  const auto n = sphere.points.cols();
  const auto& t = sphere.triangles;
  const auto made = [&](Eigen::Index n_nodes, double shear, double dilatational, int threads) {
    return message_of<Refused>([&] { StrainRates(t, n_nodes, shear, dilatational, threads); });
  };
  EXPECT_EQ(made(n, 1, 0, 1), "nothing was thrown");
  EXPECT_THAT(made(n - 1, 1, 1, 1), testing::HasSubstr("names node " + std::to_string(n - 1)));
  EXPECT_THAT(made(n, -1, 1, 1), testing::HasSubstr("shear_viscosity is -1"));
  EXPECT_THAT(made(n, 1, std::nan(""), 1), testing::HasSubstr("dilatational_viscosity is"));
  EXPECT_THAT(made(n, 1, 1, -1), testing::HasSubstr("threads = -1"));

  StrainRates rates(t, n, 1, 1, 1);
  Eigen::Matrix3Xd of_nodes = sphere.points, of_elements(3, t.cols()), wrong(3, n + 1);
  EXPECT_THROW(rates.multiply(of_nodes, of_elements), std::logic_error);
  EXPECT_THROW(rates.multiply_transposed(of_elements, of_nodes), std::logic_error);
  EXPECT_THROW(rates.set_positions(wrong), Refused);
  rates.set_positions(sphere.points);
  EXPECT_THROW(rates.multiply(wrong, of_elements), Refused);
  EXPECT_THROW(rates.multiply(of_nodes, wrong), Refused);
  EXPECT_THROW(rates.multiply_transposed(wrong, of_nodes), Refused);
  EXPECT_THROW(rates.multiply_transposed(of_elements, wrong), Refused);
}

TEST(StrainRates, NameAnElementWithoutAreaAndKeepThePositionsBefore) {
  const auto sphere = icosphere(1, 1);
  auto rates = at(sphere);
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

}  // namespace
}  // namespace tanktread::membrane::test
