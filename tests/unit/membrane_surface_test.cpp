// The membrane as a whole: rigid motion, threads, inverted elements, restart, refusals.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numbers>

#include "membrane/element.hpp"
#include "unit/membrane_support.hpp"

namespace tanktread::membrane::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

template <typename Action>
std::string inversion_message(Action action) {
  try {
    action();
  } catch (const InvertedElement& error) {
    return error.what();
  }
  return "nothing was thrown";
}

TEST(Membrane, StartsAtItsReference) {
  const auto sphere = icosphere(2, 5);
  Membrane membrane(sphere, skalak());
  EXPECT_EQ(membrane.n_nodes(), 162);
  EXPECT_EQ(membrane.n_triangles(), 320);
  EXPECT_TRUE(same_bits(membrane.positions(), sphere.points));
  EXPECT_TRUE(same_bits(membrane.reference().points, sphere.points));
  EXPECT_EQ(membrane.elastic_law().shear_modulus(), 1);
}

// Rigid motion: the strain is rounding, twice that of F, the stress of it is below 2 (G_s + K_s) = 8, and six
// corners meet in a node, each with stress times half an edge (below 1.7).
TEST(Membrane, HasNoForceAfterARigidMotion) {
  const auto sphere = icosphere(2, 5);
  Membrane membrane(sphere, skalak());
  for (int step = 1; step <= 5; ++step) {
    const Eigen::Matrix3Xd moved =
        (rotation({1, 0.5, -2}, 0.7 * step) * sphere.points).colwise() + step * Eigen::Vector3d(3, -1, 2);
    EXPECT_LT(forces(membrane, moved).cwiseAbs().maxCoeff(),
              6 * 2 * 8 * gradient_rounding(sphere, moved) * 1.7 / 2);
  }
}

TEST(Membrane, AddsIntoTheForceItIsGiven) {
  const auto sphere = icosphere(1, 1);
  Membrane membrane(sphere, skalak(), 1);
  const auto positions = randomly_moved(sphere.points, 0.05, 1);
  const auto alone = forces(membrane, positions);
  Eigen::Matrix3Xd force = Eigen::Matrix3Xd::Constant(3, sphere.points.cols(), 1.5);
  membrane.add_forces(force);
  EXPECT_TRUE(same_bits(force, (alone.array() + 1.5).matrix().eval()));
}

TEST(Membrane, ElasticPartAloneIsTheWholeForceWithoutAViscousLaw) {
  const auto sphere = icosphere(2, 1);
  Membrane membrane(sphere, skalak(), 2);
  const auto whole = forces(membrane, randomly_moved(sphere.points, 0.05, 1));
  Eigen::Matrix3Xd elastic = Eigen::Matrix3Xd::Zero(3, sphere.points.cols());
  membrane.add_elastic_forces(elastic);
  EXPECT_TRUE(same_bits(whole, elastic));
}

TEST(Membrane, NoResultDependsOnTheNumberOfThreads) {
  const auto sphere = icosphere(3, 10, {30, 30, 30});  // 1280 triangles: 20 blocks, 642 nodes
  const auto positions = randomly_moved(sphere.points, 0.3, 5);
  Membrane one(sphere, skalak(), 1);
  const auto force = forces(one, positions);
  const auto fields = one.element_fields();
  for (const int threads : {2, 3, 4}) {
    Membrane many(sphere, skalak(), threads);
    EXPECT_TRUE(same_bits(forces(many, positions), force)) << threads;
    EXPECT_EQ(many.elastic_energy() - one.elastic_energy(), 0.0) << threads;
    EXPECT_TRUE(same_bits(many.element_fields().stress, fields.stress)) << threads;
    EXPECT_TRUE(same_bits(many.element_fields().principal_stretches, fields.principal_stretches)) << threads;
    EXPECT_TRUE(same_bits(many.element_fields().area_ratio, fields.area_ratio)) << threads;
    EXPECT_TRUE(same_bits(many.history(), one.history())) << threads;
  }
}

/// Moves one corner of an element over its opposite edge; no other element around that corner inverts then.
Eigen::Matrix3Xd with_inverted(const TriangleMesh& mesh, int element) {
  Eigen::Matrix3Xd points = mesh.points;
  const Eigen::Vector3d a = points.col(mesh.triangles(0, element));
  const Eigen::Vector3d middle =
      0.5 * (points.col(mesh.triangles(1, element)) + points.col(mesh.triangles(2, element)));
  points.col(mesh.triangles(0, element)) = middle + 0.2 * (middle - a);
  return points;
}

TEST(InvertedElement, IsNamedWithItsNodesPlaceAndTurn) {
  const auto sphere = icosphere(2, 1);
  for (const int element : {0, 77, 319}) {
    Membrane membrane(sphere, skalak(), 2);
    membrane.set_positions(with_inverted(sphere, element));
    Eigen::Matrix3Xd force = Eigen::Matrix3Xd::Constant(3, sphere.points.cols(), 0.25);
    const auto history = membrane.history();
    EXPECT_THAT(inversion_message([&] { membrane.add_forces(force); }),
                AllOf(HasSubstr("element " + std::to_string(element) + " (nodes " +
                                std::to_string(sphere.triangles(0, element)) + ", "),
                      HasSubstr("turned inside out"), HasSubstr("degrees since the last step")));
    EXPECT_TRUE((force.array() == 0.25).all()) << "a call that throws leaves the force as it was";
    EXPECT_TRUE(same_bits(membrane.history(), history));
  }
}

TEST(InvertedElement, IsFoundByTheCheckAloneToo) {
  const auto sphere = icosphere(1, 1);
  Membrane checked(sphere, skalak(), 1), forced(sphere, skalak(), 1);
  const Eigen::Matrix3Xd turned = rotation({0, 0, 1}, 1.2) * sphere.points;
  checked.set_positions(turned);
  checked.check_elements();
  forces(forced, turned);
  EXPECT_TRUE(same_bits(checked.history(), forced.history())) << "the next check compares with this one";
  checked.set_positions(with_inverted(sphere, 7));
  EXPECT_THAT(inversion_message([&] { checked.check_elements(); }), HasSubstr("membrane element "));
}

TEST(InvertedElement, HasCollapsedBelowAThousandthOfItsArea) {
  const auto box = cube(1);
  Membrane membrane(box.mesh, skalak(), 1);
  // Squeezed along x, the faces normal to y and z shrink alike: the first of them is element 4.
  const auto squeezed = [&](double ratio) {
    return Eigen::Matrix3Xd(Eigen::Vector3d(ratio, 1, 1).asDiagonal() * box.mesh.points);
  };
  EXPECT_NO_THROW(forces(membrane, squeezed(0.0011)));
  EXPECT_THAT(
      inversion_message([&] { forces(membrane, squeezed(0.0009)); }),
      AllOf(HasSubstr("element 4 "), HasSubstr("has collapsed: its area is 0.0009 of its reference area, "
                                               "at least 0.001 is allowed")));
}

TEST(InvertedElement, IsReportedForAPositionThatIsNotFinite) {
  const auto sphere = icosphere(2, 1);
  const int node = 100;
  int first = 0;
  while ((sphere.triangles.col(first).array() != node).all()) ++first;
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    for (int axis = 0; axis < 3; ++axis) {
      Membrane membrane(sphere, skalak(), 2);
      Eigen::Matrix3Xd positions = sphere.points;
      positions(axis, node) = bad;
      EXPECT_THAT(inversion_message([&] { forces(membrane, positions); }),
                  AllOf(HasSubstr("element " + std::to_string(first) + " "), HasSubstr("not finite")));
    }
  }
}

// The turn of an element counts from the last call, not from the reference; a restart must know the last
// call.
TEST(MembraneHistory, CarriesTheNormalsOfTheLastCallThroughARestart) {
  const auto sphere = icosphere(1, 1);
  const auto turned = [&](double degrees) {
    return Eigen::Matrix3Xd(rotation({0, 0, 1}, degrees * std::numbers::pi / 180) * sphere.points);
  };
  Membrane membrane(sphere, skalak(), 1);
  EXPECT_NO_THROW(forces(membrane, turned(70)));
  const auto history = membrane.history();
  const auto force = forces(membrane, turned(140));

  Membrane restarted(sphere, skalak(), 1);
  restarted.restore_history(history);
  EXPECT_TRUE(same_bits(forces(restarted, turned(140)), force));
  EXPECT_TRUE(same_bits(restarted.history(), membrane.history()));

  Membrane forgetful(sphere, skalak(), 1);
  EXPECT_THROW(forces(forgetful, turned(140)), InvertedElement);
}

TEST(MembraneHistory, OfAnotherSizeIsRefused) {
  Membrane membrane(icosphere(0, 1), skalak(), 1);
  EXPECT_THAT(refusal_message([&] { membrane.restore_history(std::vector<double>(59)); }),
              AllOf(HasSubstr("59"), HasSubstr("60")));
}

TEST(Membrane, RefusesArraysOfAnotherNumberOfNodes) {
  Membrane membrane(icosphere(0, 1), skalak(), 1);
  Eigen::Matrix3Xd short_array = Eigen::Matrix3Xd::Zero(3, 11);
  EXPECT_THAT(refusal_message([&] { membrane.set_positions(short_array); }),
              AllOf(HasSubstr("position array has 11 columns"), HasSubstr("12 nodes")));
  EXPECT_THAT(refusal_message([&] { membrane.add_forces(short_array); }),
              AllOf(HasSubstr("force array has 11 columns"), HasSubstr("12 nodes")));
  EXPECT_THAT(refusal_message([&] { membrane.add_elastic_forces(short_array); }),
              AllOf(HasSubstr("force array has 11 columns"), HasSubstr("12 nodes")));
}

TEST(Membrane, RefusesAMeshWithDefectsAMissingLawAndNegativeThreads) {
  EXPECT_THAT(refusal_message([] { Membrane(turned_inside_out(icosphere(0, 1)), skalak()); }),
              AllOf(HasSubstr("membrane mesh: "), HasSubstr("inside out")));
  EXPECT_THAT(refusal_message([] { Membrane(icosphere(0, 1), nullptr); }),
              HasSubstr("an elastic law is needed"));
  EXPECT_THAT(refusal_message([] { Membrane(icosphere(0, 1), skalak(), -1); }),
              HasSubstr("threads = -1; 0 (all) or more is needed"));
}

}  // namespace
}  // namespace tanktread::membrane::test
