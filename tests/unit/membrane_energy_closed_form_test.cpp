// Measures and energies of surfaces that can be worked out by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "membrane/dihedral_angle.hpp"
#include "unit/membrane_energy_list.hpp"
#include "unit/membrane_support.hpp"

namespace tanktread::membrane::test {
namespace {

constexpr double pi = std::numbers::pi;

/// The only term's energy.
double energy(const TriangleMesh& reference, const EnergyChoice& choice, const Eigen::Matrix3Xd& positions) {
  EnergyTerms terms(reference, {choice}, 1);
  return terms.energy(positions);
}

// Sine and cosine round by up to 0.6 epsilon together, the angle by 2 epsilon near pi, and the steps of the
// function by as much again.
TEST(DihedralAngle, IsTheAngleOfSineAndCosine) {
  for (int k = -2000; k <= 2000; ++k) {
    const double angle = pi * k / 2000;
    EXPECT_NEAR(dihedral_angle(std::sin(angle), std::cos(angle)), angle,
                epsilon * (0.6 + 2 * std::abs(angle)))
        << k;
  }
  for (const double angle : {1e-5, 1e-8, 1e-100, -1e-16})  // small ones to their own digits
    EXPECT_NEAR(dihedral_angle(angle - angle * angle * angle / 6, 1 - angle * angle / 2), angle,
                4 * epsilon * std::abs(angle));
  EXPECT_EQ(dihedral_angle(0, 1), 0);
  EXPECT_EQ(dihedral_angle(0, -1), pi);
  EXPECT_NEAR(dihedral_angle(1, 0), pi / 2, 2 * epsilon);
}

// A cube of edge 2: a node has three edges of it, of length 2 and angle pi/2; the diagonals of the faces are
// flat. Each of the 12 triangles has the area 2.
TEST(Bending, OfACube) {
  const auto box = cube(2).mesh;
  MeasuredSurface surface(box, 1);
  const auto& measures = surface.measures();
  EXPECT_EQ(surface.n_edges(), 18);
  EXPECT_NEAR(measures.area, 24, 24 * 12 * epsilon);
  EXPECT_NEAR(measures.volume, 8, 8 * 12 * epsilon);
  const double modulus = 1.5, mean_curvature = 0.2;
  double expected = 0;
  for (int node = 0; node < 8; ++node) {
    const double area = 2.0 / 3 * static_cast<double>((box.triangles.array() == node).count());
    const double curvature = 3 * 2 * (pi / 2) / 4;
    EXPECT_NEAR(measures.node_area[node], area, 8 * epsilon * area);
    EXPECT_NEAR(measures.node_curvature[node], curvature, 8 * epsilon * curvature);
    expected += 2 * modulus * std::pow(curvature / area - mean_curvature, 2) * area;
  }
  const EnergyChoice choice = {"bending",
                               {{"bending_modulus", modulus}, {"spontaneous_curvature", 2 * mean_curvature}}};
  EXPECT_NEAR(energy(box, choice, box.points), expected, 40 * epsilon * expected);
}

// Inside out of a corner: the notch of a cube whose corner is pushed in. Its three edges turn from convex to
// concave, and the curvature of the corner changes its sign.
TEST(Bending, CountsConcaveEdgesAsNegative) {
  const auto box = cube(2).mesh;
  MeasuredSurface surface(box, 1);
  Eigen::Matrix3Xd dented = box.points;
  dented.col(7).setConstant(0.5);
  EXPECT_LT(surface.measure(dented, true).node_curvature[7], -1);
}

// Neighbouring faces of an icosahedron have normals at an angle of cosine sqrt(5)/3. Its edge is
// 4/sqrt(10 + 2 sqrt(5)) of the radius, and a face sqrt(3)/4 of the edge's square.
TEST(Bending, OfAnIcosahedron) {
  const double modulus = 0.7, radius = 3, edge = 4 * radius / std::sqrt(10 + 2 * std::sqrt(5.0));
  const double curvature = 5 * edge * std::acos(std::sqrt(5.0) / 3) / 4;
  const double area = 5 * std::sqrt(3.0) / 4 * edge * edge / 3;
  const double expected = 12 * 2 * modulus * curvature * curvature / area;
  const auto mesh = icosphere(0, radius);
  EXPECT_NEAR(energy(mesh, {"bending", {{"bending_modulus", modulus}}}, mesh.points), expected,
              40 * epsilon * expected);
}

// A surface s times as large has curvatures s M_i and areas s^2 A_i: without spontaneous curvature the energy
// is the same, so that forces do no work in a growth. With it, dE/ds at s = 1 is
// -2 kappa_b c_0 sum of M + kappa_b c_0^2 A.
TEST(Bending, DoesNoWorkInAGrowthButThatOfTheSpontaneousCurvature) {
  const auto sphere = icosphere(2, 2);
  const auto positions = randomly_moved(sphere.points, 0.1, 12);
  MeasuredSurface surface(sphere, 1);
  const auto& measures = surface.measure(positions, true);
  const double modulus = 1.5;
  for (const double curvature : {0.0, 0.8, -0.3}) {
    EnergyTerms terms(sphere,
                      {{"bending", {{"bending_modulus", modulus}, {"spontaneous_curvature", curvature}}}}, 1);
    const auto force = forces(terms, positions);
    const double expected = 2 * modulus * curvature * measures.node_curvature.sum() -
                            modulus * curvature * curvature * measures.area;
    // Each product rounds, and the forces in it by some 50 epsilon.
    const double bound = 50 * epsilon * force.cwiseProduct(positions).cwiseAbs().sum();
    EXPECT_NEAR(force.cwiseProduct(positions).sum(), expected, bound) << curvature;
    const double grown = terms.energy(1.7 * positions), here = terms.energy(positions);
    if (curvature == 0) {
      EXPECT_NEAR(grown, here, 100 * epsilon * here);
    } else {
      EXPECT_GT(std::abs(grown - here), 0.01 * here);
    }
  }
}

// All areas of a sphere s times as large are s^2 times as large, the volume s^3. The excess of an area keeps
// the rounding of the area, at most 80 epsilon.
TEST(AreaAndVolume, OfScaledSpheres) {
  const auto sphere = icosphere(1, 2, {5, 6, 7});
  const MeasuredSurface surface(sphere, 1);
  const double area = surface.measures().area, volume = surface.measures().volume, modulus = 1.3;
  for (const double s : {0.8, 1.01, 1.5}) {
    const Eigen::Matrix3Xd scaled = s * sphere.points;
    const double area_strain = s * s - 1, volume_strain = s * s * s - 1;
    const double by_area = modulus / 2 * area * area_strain * area_strain;
    const double by_volume = modulus / 2 * volume * volume_strain * volume_strain;
    const double rounding = 2 * 80 * epsilon * 4;
    EXPECT_NEAR(energy(sphere, {"global-area", {{"area_modulus", modulus}}}, scaled), by_area,
                rounding * by_area / std::abs(area_strain));
    EXPECT_NEAR(energy(sphere, {"local-area", {{"local_area_modulus", modulus}}}, scaled), by_area,
                rounding * by_area / std::abs(area_strain));
    EXPECT_NEAR(energy(sphere, {"volume", {{"volume_modulus", modulus}}}, scaled), by_volume,
                rounding * by_volume / std::abs(volume_strain));
  }
}

// The reference of other values, at the reference surface: A = 24 and V = 8 of a cube of edge 2.
TEST(AreaAndVolume, AgainstValuesThatAreGiven) {
  const auto box = cube(2).mesh;
  const double modulus = 1.3;
  EXPECT_NEAR(energy(box, {"global-area", {{"area_modulus", modulus}, {"reference_area", 30}}}, box.points),
              modulus / 2 * 36 / 30, 100 * epsilon);
  // Each of the 12 triangles has 2 of 2.5.
  EXPECT_NEAR(
      energy(box, {"local-area", {{"local_area_modulus", modulus}, {"reference_area", 30}}}, box.points),
      12 * modulus / 2 * 0.25 / 2.5, 100 * epsilon);
  EXPECT_NEAR(energy(box, {"volume", {{"volume_modulus", modulus}, {"reference_volume", 5}}}, box.points),
              modulus / 2 * 9 / 5, 100 * epsilon);
}

// Triangles of one total area but other shares: the global area is at rest, the local areas are not.
TEST(AreaAndVolume, LocalAreasFeelWhatTheWholeDoesNot) {
  const auto box = cube(2).mesh;
  const Eigen::Matrix3Xd longer = Eigen::Vector3d(2, 1, 1).asDiagonal() * box.points;
  const double area = MeasuredSurface({longer, box.triangles}, 1).measures().area;  // 8 + 16 + 16
  EXPECT_NEAR(area, 40, 40 * 12 * epsilon);
  EXPECT_NEAR(energy(box, {"global-area", {{"area_modulus", 1}, {"reference_area", 40}}}, longer), 0, 1e-24);
  // Triangles at rest have 40/12: four of 2, eight of 4.
  const double at_rest = 40.0 / 12;
  EXPECT_NEAR(energy(box, {"local-area", {{"local_area_modulus", 1}, {"reference_area", 40}}}, longer),
              0.5 * (4 * std::pow(2 - at_rest, 2) + 8 * std::pow(4 - at_rest, 2)) / at_rest, 100 * epsilon);
}

// With a small pressure modulus the force on a node is minus the pressure times a third of the area vectors
// of its triangles: on a cube's face, along its normal; together, nothing.
TEST(AreaAndVolume, VolumePushesInwardsWhereItIsTooLarge) {
  const auto sphere = icosphere(2, 2);
  EnergyTerms terms(sphere, {{"volume", {{"volume_modulus", 3}}}}, 1);
  const auto force = forces(terms, 1.1 * sphere.points);
  const double pressure = 3 * (std::pow(1.1, 3) - 1), volume = MeasuredSurface(sphere, 1).measures().volume;
  for (Eigen::Index node = 0; node < force.cols(); ++node)
    EXPECT_LT(force.col(node).dot(sphere.points.col(node)), 0) << node;
  // The work of a growth, -p dV = -3 p V. 600 products round.
  const double expected = -3 * pressure * std::pow(1.1, 3) * volume;
  EXPECT_NEAR(force.cwiseProduct(1.1 * sphere.points).sum(), expected, 600 * epsilon * std::abs(expected));
}

}  // namespace
}  // namespace tanktread::membrane::test
