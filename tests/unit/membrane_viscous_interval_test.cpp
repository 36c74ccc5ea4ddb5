// A membrane with viscosity whose stress is updated every N steps: what is kept in between, which strain an
// update takes, and a restart within an interval.
#include <gtest/gtest.h>

#include <cmath>

#include "membrane/element.hpp"
#include "membrane/viscous_law.hpp"
#include "unit/membrane_viscous_support.hpp"

namespace tanktread::membrane::test {
namespace {

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
    const Eigen::Vector3i nodes = sphere.triangles.col(t);
    const auto element = reference_element(corners_of(sphere.points, nodes));
    const SurfaceGradient f = deformation_gradient(corners_of(membrane.positions(), nodes), element);
    const auto c = cauchy_green(f);
    ViscousState state{};
    ViscousLaw(parameters).advance({}, 0.5 * (c - unit_tensor), state);
    const SurfaceGradient r = polar_rotation(f, right_stretch(c));
    const Eigen::Matrix3d expected = r * ViscousLaw::stress(state).matrix() * r.transpose();
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
  // E grows evenly, by e a step, and at small strain D = dE/dt. With the latest strain each update of N = 4
  // sees 4 e. The mean of e to 4 e is 2.5 e, that of the next four 6.5 e: the average's first update sees 2.5
  // e, the second 4 e as well. The dilatational stress of an update is kept by the factor A at the next.
  const auto sphere = icosphere(1, 1);
  auto parameters = soft();
  parameters.interval = 4;
  auto latest = viscous_membrane(sphere, parameters);
  parameters.sampling = StrainSampling::moving_average;
  auto average = viscous_membrane(sphere, parameters);
  const double decay =
      maxwell_scheme(parameters.scheme)
          .step(2 * parameters.dilatational_viscosity, parameters.dilatational_spring, parameters.interval)
          .decay;
  const auto stress_after_four_more = [&](Membrane& membrane, int step) {
    for (int k = 1; k <= 4; ++k) forces(membrane, (1 + 1e-6 * (step + k)) * sphere.points);
    return membrane.element_fields().viscous_stress(0, 0);
  };
  // Strains of 8e-6 make the terms left out that much smaller, and rounding 1e-16/1e-6.
  const double full = stress_after_four_more(latest, 0);
  EXPECT_NEAR(stress_after_four_more(average, 0) / full, 2.5 / 4, 2e-5);
  EXPECT_NEAR(stress_after_four_more(latest, 4) / full, decay + 1, 4e-5);
  EXPECT_NEAR(stress_after_four_more(average, 4) / full, decay * 2.5 / 4 + 1, 4e-5);
}

class StrainSamplings : public testing::TestWithParam<StrainSampling> {};
INSTANTIATE_TEST_SUITE_P(Both, StrainSamplings,
                         testing::Values(StrainSampling::latest, StrainSampling::moving_average),
                         [](const auto& tested) {
                           return std::string(tested.param == StrainSampling::latest ? "latest"
                                                                                     : "moving_average");
                         });

// Two intervals of four steps of an uneven motion at finite strain, element by element. An update takes the
// last of the four strains, or their mean (Eqs. 2.36-2.37) from a sum that begins anew; the stress goes on
// with the law from the strain that the update before has taken to this one, which is kept for the next.
TEST_P(StrainSamplings, EachUpdateTakesTheStrainOfItsOwnInterval) {
  const auto sphere = icosphere(1, 1);
  auto parameters = soft();
  parameters.interval = 4;
  parameters.sampling = GetParam();
  const ViscousLaw law(parameters);
  auto membrane = viscous_membrane(sphere, parameters);
  std::vector<ViscousState> states(sphere.triangles.cols(), ViscousState{});
  Eigen::Matrix3Xd last = Eigen::Matrix3Xd::Zero(3, sphere.triangles.cols());
  for (int update = 1; update <= 2; ++update) {
    Eigen::Matrix3Xd latest, sum = 0 * last;
    for (int step = 4 * update - 3; step <= 4 * update; ++step) {
      forces(membrane, moved(sphere, step));
      latest = strains(sphere, moved(sphere, step));
      sum += latest;
    }
    const Eigen::Matrix3Xd sample = GetParam() == StrainSampling::latest ? latest : sum / 4;
    ASSERT_TRUE(bounds_hold(membrane, sample - last));
    ASSERT_GT((sample - last).cwiseAbs().maxCoeff(), 0.02);
    const auto found = element_histories(membrane);
    const double rounding = gradient_rounding(sphere, moved(sphere, 4 * update));
    EXPECT_LT((found.last_strain - sample).cwiseAbs().maxCoeff(), strain_roundings * rounding) << update;
    for (Eigen::Index t = 0; t < sphere.triangles.cols(); ++t) {
      law.advance(tensor(last.col(t)), tensor(sample.col(t)), states[t]);
      for (int part = 0; part < 3; ++part) {
        ASSERT_NEAR(found.stress(part, t), states[t][part], update * stress_roundings * rounding)
            << "update " << update << ", element " << t;
      }
    }
    last = sample;
  }
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

}  // namespace
}  // namespace tanktread::membrane::test
