// A membrane with viscosity: its forces, and what turns with it. (Its intervals:
// membrane_viscous_interval_test.cpp)
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "membrane/element.hpp"
#include "unit/membrane_viscous_support.hpp"

namespace tanktread::membrane::test {
namespace {

TEST(ViscousMembrane, AtRestHasTheElasticForceAlone) {
  const auto sphere = icosphere(1, 1);
  Membrane elastic(sphere, skalak(), 1);
  auto viscous = viscous_membrane(sphere, soft());
  ASSERT_EQ(elastic.viscous_law(), nullptr);
  ASSERT_NE(viscous.viscous_law(), nullptr);
  // E of the first step is the rounding of F, twice; its stress is below 4 (mu_s + mu_d) = 20 times that, and
  // six corners meet in a node, each with stress times half an edge (below 0.7).
  const double bound = 6 * 2 * 20 * gradient_rounding(sphere, sphere.points) * 0.7 / 2;
  const Eigen::Matrix3Xd expected = forces(elastic, sphere.points);
  for (int step = 0; step < 3; ++step) {
    EXPECT_LT((forces(viscous, sphere.points) - expected).cwiseAbs().maxCoeff(), bound);
  }
}

TEST(ViscousMembrane, SwellingEvenlyHasTheForceOfATension) {
  // With the rate ln g a step the viscous stress is mu_d 2 ln g I (Eq. 2.9): the force of that interfacial
  // tension, which another law gives. A spring so stiff that int1 gives the dashpot's stress to rounding; the
  // law sees 2 tanh(ln g) for 2 ln g, (ln g)^2/3 less, relatively. What else differs is rounding: that of the
  // strain increment (E has the size 1, the increment 0.01) and of the difference of total and elastic force.
  const auto sphere = icosphere(2, 5);
  auto parameters = soft();
  parameters.scheme = "int1";
  parameters.shear_viscosity = 0;
  parameters.dilatational_viscosity = 30;
  parameters.dilatational_spring = 1e6;
  auto membrane = viscous_membrane(sphere, parameters);
  const double g = 1.01;
  viscous_forces(membrane, 1.2 * sphere.points);
  const Eigen::Matrix3Xd force = viscous_forces(membrane, 1.2 * g * sphere.points);
  const double tension = parameters.dilatational_viscosity * 2 * std::log(g);
  Membrane droplet(sphere, make_elastic_law("interfacial-tension", {.interfacial_tension = tension}), 1);
  const Eigen::Matrix3Xd expected = forces(droplet, 1.2 * g * sphere.points);
  const double shorter = std::pow(std::log(g), 2) / 3;
  EXPECT_NEAR((force - expected).norm() / expected.norm(), shorter, 0.01 * shorter);
}

TEST(ViscousMembrane, ForcesDoTheVirtualWorkOfTheStress) {
  // Sum F . d = -sum A0 S : dE for any displacement d (Eq. 2.25 in the weak form), S = J F^+ sigma F^+T from
  // the Cauchy stress in space. dE by central differences over h = 1e-6: exact to h^2 but for rounding
  // epsilon/h, relative to strains of the size of d's gradient.
  const auto sphere = icosphere(2, 1);
  auto membrane = viscous_membrane(sphere, soft());
  for (int step = 1; step < 5; ++step) viscous_forces(membrane, moved(sphere, step));
  const Eigen::Matrix3Xd x = moved(sphere, 5);
  const Eigen::Matrix3Xd force = viscous_forces(membrane, x);
  const auto fields = membrane.element_fields();
  const Eigen::Matrix3Xd displacement = randomly_moved(0 * x, 1, 3);
  const double h = 1e-6;
  double work = 0, size = 0;
  for (Eigen::Index t = 0; t < sphere.triangles.cols(); ++t) {
    const Eigen::Vector3i nodes = sphere.triangles.col(t);
    const auto element = reference_element(corners_of(sphere.points, nodes));
    const SurfaceGradient f = deformation_gradient(corners_of(x, nodes), element);
    const auto strained = [&](double by) {
      const Eigen::Matrix3Xd displaced = x + by * displacement;
      return cauchy_green(deformation_gradient(corners_of(displaced, nodes), element)).matrix();
    };
    const Eigen::Matrix2d strain = (strained(h) - strained(-h)) / (4 * h);
    const Eigen::Matrix3d sigma =
        Eigen::Map<const Eigen::Matrix3d>(fields.viscous_stress.col(t).data());  // symmetric
    const Eigen::Matrix2d c = cauchy_green(f).matrix();
    const Eigen::Matrix<double, 2, 3> inverse = c.inverse() * f.transpose();
    const Eigen::Matrix2d stress = std::sqrt(c.determinant()) * inverse * sigma * inverse.transpose();
    const double part = element.area * (stress * strain).trace();
    work -= part;
    size += std::abs(part);
  }
  ASSERT_GT(size, 0.01);
  EXPECT_NEAR((force.array() * displacement.array()).sum(), work, 1e-8 * size);
}

class ViscousMembraneForm : public testing::TestWithParam<ViscousForm> {};
INSTANTIATE_TEST_SUITE_P(All, ViscousMembraneForm, testing::ValuesIn(viscous_forms()),
                         [](const auto& tested) { return test_name(tested.param); });

// A whole motion, and the same turned further in each step: the stress components in the frame of the
// element, which are its history, stay the same, and the forces turn.
//
// Rounding of a force: a node has six corners, each with a force F S times half a reference edge (below
// 0.17), and |F| is below 1.2. The elastic S changes by 10 (G_s + K_s) = 40 (as in
// membrane_law_force_test.cpp) times the strain's norm, 2 x 8 r. The viscous S = J U^-1 s U^-1 changes
// by 1.2/0.8 times the norm of the stress, 2.4 x 50 r an update, and by 8 r with U (a stress of 0.1); F
// itself by 7 r, times an S below 10. After n updates 6 x 0.17 x (1.2 x (640 + 180 n + 8) + 70) r is below
// 900 (n + 1) r.
TEST_P(ViscousMembraneForm, StressStaysAndForcesTurnWithTheMembrane) {
  const auto sphere = icosphere(2, 1);
  auto parameters = soft();
  parameters.scheme = GetParam().scheme;
  parameters.measure = GetParam().measure;
  auto plain = viscous_membrane(sphere, parameters), turned = viscous_membrane(sphere, parameters);
  for (int step = 1; step <= 7; ++step) {
    const Eigen::Matrix3d r = rotation({1, 2, -1}, 0.5 * step);
    const Eigen::Matrix3Xd x = moved(sphere, step), last_strain = element_histories(plain).last_strain;
    const Eigen::Matrix3Xd force = forces(plain, x), rotated = forces(turned, r * x);
    const auto expected = element_histories(plain), found = element_histories(turned);
    ASSERT_TRUE(bounds_hold(plain, expected.last_strain - last_strain));
    ASSERT_GT(force.norm(), 0.1);
    ASSERT_GT(expected.stress.colwise().norm().minCoeff(), 0.001);  // every element has a history
    ASSERT_GT(expected.stress.colwise().norm().maxCoeff(), 0.01);

    const double rounding = gradient_rounding(sphere, x);
    EXPECT_LT((found.last_strain - expected.last_strain).cwiseAbs().maxCoeff(), strain_roundings * rounding);
    EXPECT_LT((found.stress - expected.stress).cwiseAbs().maxCoeff(), step * stress_roundings * rounding);
    EXPECT_LT((rotated - r * force).cwiseAbs().maxCoeff(), 900 * (step + 1) * rounding);
  }
}

TEST(ViscousMembrane, AHistoryOfAnotherLawIsRefused) {
  const auto sphere = icosphere(0, 1);
  Membrane elastic(sphere, skalak(), 1);
  auto viscous = viscous_membrane(sphere, soft());
  EXPECT_THROW(viscous.restore_history(elastic.history()), std::invalid_argument);
  EXPECT_THROW(elastic.restore_history(viscous.history()), std::invalid_argument);
  // The steps since the last update, which follow the normals, are 0 to N.
  const auto n_normals = static_cast<std::size_t>(3 * viscous.n_triangles());
  for (const double steps : {-1.0, 2.0, 0.5, std::nan("")}) {
    auto history = viscous.history();
    history[n_normals] = steps;
    EXPECT_THROW(viscous.restore_history(history), std::invalid_argument) << steps;
  }
}

TEST(ViscousMembrane, NoResultDependsOnTheNumberOfThreads) {
  const auto sphere = icosphere(3, 1);
  auto one = viscous_membrane(sphere, soft(), 1), three = viscous_membrane(sphere, soft(), 3);
  for (int step = 1; step <= 4; ++step) {
    EXPECT_TRUE(same_bits(forces(three, moved(sphere, step)), forces(one, moved(sphere, step))));
  }
  EXPECT_TRUE(same_bits(three.history(), one.history()));
  EXPECT_TRUE(same_bits(three.element_fields().stress, one.element_fields().stress));
  EXPECT_TRUE(same_bits(three.element_fields().viscous_stress, one.element_fields().viscous_stress));
}

TEST(ViscousMembrane, AnInvertedElementLeavesTheHistoryAsItWas) {
  const auto sphere = icosphere(2, 1);
  auto membrane = viscous_membrane(sphere, soft());
  forces(membrane, moved(sphere, 1));
  const auto history = membrane.history();
  EXPECT_THROW(forces(membrane, rotation({0, 0, 1}, 3.0) * moved(sphere, 1)), InvertedElement);
  EXPECT_TRUE(same_bits(membrane.history(), history));
}

}  // namespace
}  // namespace tanktread::membrane::test
