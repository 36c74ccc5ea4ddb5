// A membrane that starts in another shape than the stress-free one: as if it had always been there.
#include <gtest/gtest.h>

#include "membrane/revolved_mesh.hpp"
#include "unit/membrane_viscous_support.hpp"

namespace tanktread::membrane::test {
namespace {

/// A red cell over the spheroid of its area that is nearly a sphere, as of reduced volume 0.95.
struct RedCell {
  TriangleMesh start = revolved_mesh(biconcave_meridian(1), 2);
  TriangleMesh stress_free =
      revolved_mesh(spheroid_meridian(1, spheroid_aspect_ratio(0.95, Spheroid::oblate)), 2);
};

/// Of a strain that is computed twice, here and in a step: the bound of ViscousMembrane.AtRestHasThe..., its
/// rounding that of E, which is up to 3 times F here (entries of F up to 1.5) in place of F.
double viscous_rounding(const TriangleMesh& reference, const Eigen::Matrix3Xd& positions) {
  return 3 * 6 * 2 * 20 * gradient_rounding(reference, positions) * 0.7 / 2;
}

TEST(BeginAt, TheReferenceIsANewMembraneToTheLastBit) {
  const auto sphere = icosphere(2, 3);
  for (const int interval : {1, 3}) {
    auto parameters = soft();
    parameters.interval = interval;
    auto fresh = viscous_membrane(sphere, parameters), begun = viscous_membrane(sphere, parameters);
    for (int step = 1; step < 6; ++step) viscous_forces(begun, moved(sphere, step));
    begun.begin_at(sphere.points);
    EXPECT_TRUE(same_bits(begun.positions(), fresh.positions()));
    EXPECT_TRUE(same_bits(begun.history(), fresh.history()));
  }
}

TEST(BeginAt, HeldStillThereIsNoViscousStress) {
  const RedCell cell;
  for (const auto& form : viscous_forms()) {
    for (const int interval : {1, 3}) {
      for (const auto sampling : {StrainSampling::latest, StrainSampling::moving_average}) {
        auto parameters = soft();
        parameters.scheme = form.scheme;
        parameters.measure = form.measure;
        parameters.interval = interval;
        parameters.sampling = sampling;
        auto membrane = viscous_membrane(cell.stress_free, parameters);
        membrane.begin_at(cell.start.points);
        for (int step = 0; step < 7; ++step) {
          EXPECT_LT(viscous_forces(membrane, cell.start.points).cwiseAbs().maxCoeff(),
                    viscous_rounding(cell.stress_free, cell.start.points))
              << form << ", step " << step;
        }
      }
    }
  }
  // Without it the strain of the start is one of the first step.
  auto jumping = viscous_membrane(cell.stress_free, soft());
  EXPECT_GT(viscous_forces(jumping, cell.start.points).cwiseAbs().maxCoeff(), 0.01);
}

// With D for the rate the viscous stress is that of the motion alone: the force does not know what shape is
// free of stress. E there and here differ by the strain of the start, U by its stretch, so the increments of
// D dt differ as the scheme is centred: by the third order of the strain of a step, 3e-4 each of the three
// steps below, whose strains are up to 0.07 (0.07^3 = 3.4e-4).
TEST(BeginAt, TheViscousForceIsThatOfTheMotion) {
  const RedCell cell;
  auto over_spheroid = viscous_membrane(cell.stress_free, soft()),
       over_itself = viscous_membrane(cell.start, soft());
  over_spheroid.begin_at(cell.start.points);
  double largest = 0;
  for (int step = 1; step <= 3; ++step) {
    const auto there = viscous_forces(over_spheroid, moved(cell.start, step));
    const auto here = viscous_forces(over_itself, moved(cell.start, step));
    largest = std::max(largest, here.cwiseAbs().maxCoeff());
    EXPECT_LT((there - here).norm(), 0.05 * here.norm()) << step;
  }
  EXPECT_GT(largest, 0.01);
}

TEST(BeginAt, TheFirstCheckComparesWithTheNormalsThere) {
  // Half a turn: from the reference every normal but those of the axis would have turned too far.
  const auto sphere = icosphere(1, 1);
  const Eigen::Matrix3Xd turned = rotation({0, 0, 1}, 3.14159) * sphere.points;
  Membrane membrane(sphere, skalak(), 1);
  membrane.set_positions(turned);
  EXPECT_THROW(membrane.check_elements(), InvertedElement);
  membrane.begin_at(turned);
  EXPECT_NO_THROW(membrane.check_elements());
}

TEST(BeginAt, ElasticForcesAreThoseOfTheStressFreeShape) {
  const RedCell cell;
  Membrane begun(cell.stress_free, skalak(), 1), moved_there(cell.stress_free, skalak(), 1);
  begun.begin_at(cell.start.points);
  EXPECT_TRUE(same_bits(forces(begun, cell.start.points), forces(moved_there, cell.start.points)));
  EXPECT_GT(begun.elastic_energy(), 0.1);
}

TEST(BeginAt, RefusesAnotherNumberOfNodes) {
  Membrane membrane(icosphere(1, 1), skalak(), 1);
  EXPECT_THROW(membrane.begin_at(icosphere(0, 1).points), std::invalid_argument);
}

TEST(BeginAt, AHistoryTakenThereGoesOnToTheLastBit) {
  const RedCell cell;
  auto whole = viscous_membrane(cell.stress_free, soft()),
       resumed = viscous_membrane(cell.stress_free, soft());
  whole.begin_at(cell.start.points);
  resumed.begin_at(cell.start.points);
  resumed.restore_history(whole.history());
  for (int step = 1; step < 4; ++step) {
    const auto x = moved(cell.start, step);
    EXPECT_TRUE(same_bits(forces(whole, x), forces(resumed, x)));
    resumed.restore_history(whole.history());
  }
}

}  // namespace
}  // namespace tanktread::membrane::test
