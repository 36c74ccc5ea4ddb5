// A membrane with viscosity: its forces, the steps between updates, and what a restart has to carry.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "membrane/element.hpp"
#include "unit/membrane_support.hpp"

namespace tanktread::membrane::test {
namespace {

/// Springs that relax within a few steps, so that the history counts.
ViscousParameters soft() {
  ViscousParameters parameters;
  parameters.shear_viscosity = 2;
  parameters.dilatational_viscosity = 3;
  parameters.shear_spring = 0.7;
  parameters.dilatational_spring = 0.4;
  return parameters;
}

Membrane viscous_membrane(const TriangleMesh& mesh, const ViscousParameters& parameters, int threads = 1) {
  return {mesh, skalak(), std::make_shared<const ViscousLaw>(parameters), threads};
}

/// A motion of finite strain without any symmetry, smooth in time; at rest at step 0.
Eigen::Matrix3Xd moved(const TriangleMesh& mesh, int step) {
  return mesh.points + std::sin(0.1 * step) * (smoothly_deformed(mesh.points) - mesh.points);
}

Eigen::Matrix3Xd viscous_forces(Membrane& membrane, const Eigen::Matrix3Xd& positions) {
  Eigen::Matrix3Xd force = forces(membrane, positions);
  Eigen::Matrix3Xd elastic = Eigen::Matrix3Xd::Zero(3, positions.cols());
  membrane.add_elastic_forces(elastic);
  return force - elastic;
}

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
    const auto corners = [&](const Eigen::Matrix3Xd& points) {
      Eigen::Matrix3d result;
      for (int k = 0; k < 3; ++k) result.col(k) = points.col(sphere.triangles(k, t));
      return result;
    };
    const auto element = reference_element(corners(sphere.points));
    const SurfaceGradient f = deformation_gradient(corners(x), element);
    const auto strained = [&](double by) {
      return cauchy_green(deformation_gradient(corners(x + by * displacement), element));
    };
    const Eigen::Matrix2d strain = (strained(h) - strained(-h)) / (4 * h);
    const Eigen::Matrix3d sigma =
        Eigen::Map<const Eigen::Matrix3d>(fields.viscous_stress.col(t).data());  // symmetric
    const Eigen::Matrix2d c = cauchy_green(f);
    const Eigen::Matrix<double, 2, 3> inverse = c.inverse() * f.transpose();
    const Eigen::Matrix2d stress = std::sqrt(c.determinant()) * inverse * sigma * inverse.transpose();
    const double part = element.area * (stress * strain).trace();
    work -= part;
    size += std::abs(part);
  }
  ASSERT_GT(size, 0.01);
  EXPECT_NEAR((force.array() * displacement.array()).sum(), work, 1e-8 * size);
}

TEST(ViscousMembrane, ForcesTurnWithTheMembraneAndItsHistory) {
  // A whole motion, and the same turned further in each step: the forces of each step turn alike. Strain and
  // stress are rounded as F is; the increments of the strain are summed with factors below 4, in seven steps.
  const auto sphere = icosphere(2, 1);
  auto plain = viscous_membrane(sphere, soft()), turned = viscous_membrane(sphere, soft());
  for (int step = 1; step <= 7; ++step) {
    const Eigen::Matrix3d r = rotation({1, 2, -1}, 0.5 * step);
    const Eigen::Matrix3Xd x = moved(sphere, step);
    const Eigen::Matrix3Xd force = forces(plain, x), rotated = forces(turned, r * x);
    ASSERT_GT(force.norm(), 0.1);
    EXPECT_LT((rotated - r * force).cwiseAbs().maxCoeff(), 7 * 6 * 2 * 8 * 4 * gradient_rounding(sphere, x));
  }
}

TEST(ViscousMembrane, BetweenUpdatesTheStressIsKept) {
  // One update after three steps, of the strain of that step: what the law gives for it.
  const auto sphere = icosphere(1, 1);
  auto parameters = soft();
  parameters.interval = 3;
  auto membrane = viscous_membrane(sphere, parameters);
  for (int step = 1; step <= 2; ++step) EXPECT_EQ(viscous_forces(membrane, moved(sphere, step)).norm(), 0.0);
  viscous_forces(membrane, moved(sphere, 3));
  const auto fields = membrane.element_fields();
  for (const Eigen::Index t : {0, 41}) {
    Eigen::Matrix3d reference, corners;
    for (int k = 0; k < 3; ++k) {
      reference.col(k) = sphere.points.col(sphere.triangles(k, t));
      corners.col(k) = membrane.positions().col(sphere.triangles(k, t));
    }
    const SurfaceGradient f = deformation_gradient(corners, reference_element(reference));
    const Eigen::Matrix2d c = cauchy_green(f);
    ViscousState state{};
    ViscousLaw(parameters).advance(Eigen::Matrix2d::Zero(), 0.5 * (c - Eigen::Matrix2d::Identity()), state);
    const SurfaceGradient r = polar_rotation(f, right_stretch(c));
    const Eigen::Matrix3d expected = r * ViscousLaw::stress(state) * r.transpose();
    const Eigen::Matrix3d stress = Eigen::Map<const Eigen::Matrix3d>(fields.viscous_stress.col(t).data());
    ASSERT_GT(expected.norm(), 0.01);
    EXPECT_LT((stress - expected).norm(), 1e-13);  // rounding of numbers of size 1, a few dozen operations
  }
  // Two steps in which nothing moves: no update, so no relaxation.
  const Eigen::Matrix3Xd force = viscous_forces(membrane, moved(sphere, 3));
  EXPECT_TRUE(same_bits(viscous_forces(membrane, moved(sphere, 3)), force));
  EXPECT_LT(viscous_forces(membrane, moved(sphere, 3)).norm(), 0.9 * force.norm());
}

TEST(ViscousMembrane, TheMovingAverageOfOneStepIsTheLatestStrain) {
  const auto sphere = icosphere(2, 1);
  auto parameters = soft();
  auto latest = viscous_membrane(sphere, parameters);
  parameters.sampling = StrainSampling::moving_average;
  auto average = viscous_membrane(sphere, parameters);
  for (int step = 1; step <= 10; ++step) {
    EXPECT_TRUE(same_bits(forces(average, moved(sphere, step)), forces(latest, moved(sphere, step)))) << step;
  }
}

TEST(ViscousMembrane, TheMovingAverageLagsByHalfAnInterval) {
  // E grows evenly, by e a step. Latest: the first update sees N e, the later ones N e. The average: the
  // mean of e, 2 e .. N e first, which is (N + 1)/2 e, and N e from then on. At small strain D = dE/dt.
  const auto sphere = icosphere(1, 1);
  auto parameters = soft();
  parameters.interval = 4;
  auto latest = viscous_membrane(sphere, parameters);
  parameters.sampling = StrainSampling::moving_average;
  auto average = viscous_membrane(sphere, parameters);
  const auto stress_after_four = [&](Membrane& membrane) {
    for (int step = 1; step <= 4; ++step) forces(membrane, (1 + 1e-6 * step) * sphere.points);
    return membrane.element_fields().viscous_stress(0, 0);
  };
  // Strains of 4e-6 make the terms left out that much smaller, and rounding 1e-16/1e-6.
  const double full = stress_after_four(latest);
  EXPECT_NEAR(stress_after_four(average) / full, 2.5 / 4, 1e-5);
}

TEST(ViscousMembrane, ARestartWithinAnIntervalGoesOnBitForBit) {
  const auto sphere = icosphere(2, 1);
  for (const auto sampling : {StrainSampling::latest, StrainSampling::moving_average}) {
    auto parameters = soft();
    parameters.interval = 3;
    parameters.sampling = sampling;
    for (const int stop : {3, 4, 5}) {
      auto whole = viscous_membrane(sphere, parameters);
      for (int step = 1; step <= stop; ++step) forces(whole, moved(sphere, step));
      auto restarted = viscous_membrane(sphere, parameters);
      restarted.set_positions(whole.positions());
      restarted.restore_history(whole.history());
      for (int step = stop + 1; step <= stop + 7; ++step) {
        EXPECT_TRUE(same_bits(forces(restarted, moved(sphere, step)), forces(whole, moved(sphere, step))));
      }
      EXPECT_TRUE(same_bits(restarted.history(), whole.history()));
    }
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
