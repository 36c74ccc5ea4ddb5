// Stencils with shear dipoles: what they take from the grid, and what they conserve.
#include <gtest/gtest.h>

#include "tests/unit/coupler_dipole_support.hpp"

namespace tanktread::coupler::dipole_test {
namespace {

using namespace test;

const Grid box = {{24, 20, 22}, {true, true, true}};
constexpr std::size_t n_box_nodes = 24 * 20 * 22;
constexpr double length = 0.3;

/// A sphere across no face, with normals to 2^-20.
Sheared one_sphere(double dipole_length = length) {
  Sheared sheared;
  const Vector centre = {11.0, 9.0, 12.0};
  sheared.add(sphere(300, 5.5, centre), centre, dipole_length);
  return sheared;
}

class CouplerDipoles : public ::testing::TestWithParam<Kernel> {
 protected:
  Coupler coupler_{box, GetParam(), 1};
};
INSTANTIATE_TEST_SUITE_P(All, CouplerDipoles, ::testing::ValuesIn(kernels()),
                         [](const auto& tested) { return tested.param.name; });

// Bounds: a weight or slope of a stencil is a product of three numbers, right to 132 eps (that of the slopes
// of stockie6, two of whose factors are below 5/8). Their sizes add up to 1.6^2 * 3.2 at most (those of the
// six slopes of stockie6 to 1.6, the sum of two); 216 of them are added. With fields of a size u a sum is off
// by (132 * 8.2 + 216 * 8.2) u eps = 2900 u eps; with the dipole twice three such sums times 0.3 are added.
constexpr double bound_of_unit_field = 2900 * (1 + 6 * length) * eps;

const Matrix gradient = {Vector{0.5, -0.25, 0.125}, Vector{0.3, -0.2, 1.0}, Vector{-0.7, 0.4, -0.3}};

/// The largest difference between what the nodes get of the field A x and A x + d P (A + A^T) n.
double error_of_linear(Coupler& coupler, const Sheared& sheared, const Matrix& a) {
  build(coupler, sheared);
  const Numbers field = on_grid_nodes(coupler, box, [&](const Vector& x) { return times(a, x); });
  const Numbers velocity = interpolate(coupler, field, sheared.sizes());
  double largest = 0;
  for (std::size_t k = 0; k < velocity.size(); k += 3) {
    const double* x = &sheared.nodes[0][k];
    const Vector plain = times(a, {x[0], x[1], x[2]}), shear = shear_of(a, &sheared.normals[0][k]);
    for (int c = 0; c < 3; ++c)
      largest = std::max(largest, std::abs(velocity[k + c] - plain[c] - sheared.lengths[0] * shear[c]));
  }
  return largest;
}

TEST_P(CouplerDipoles, AddTheShearOfALinearFieldJustWithTheFirstMoment) {
  for (const double d : {length, -length}) {
    const double error = error_of_linear(coupler_, one_sphere(d), gradient);
    if (GetParam().first_moment) {
      EXPECT_LE(error, 24 * bound_of_unit_field);  // |A x| <= 24 in the box, |A| <= 1
    } else {
      // Slopes up to 0.21 too small (coupler_slopes_test.cpp), of a shear up to 1.6: 0.1; and the first
      // moment itself, 0.02 a component of A x.
      EXPECT_GT(error, 0.02);
      EXPECT_LT(error, 0.3 * 0.215 * 2 * 1.6 + 0.0211 * 2);
    }
  }
}

TEST_P(CouplerDipoles, LeaveRigidMotionsAlone) {
  const Vector turning = {0.3, -0.5, 0.7};
  const Matrix rotation = {Vector{0, -turning[2], turning[1]}, Vector{turning[2], 0, -turning[0]},
                           Vector{-turning[1], turning[0], 0}};
  const auto change = [&](const Matrix& a) {
    const auto velocity = [&](double d) {
      build(coupler_, one_sphere(d));
      return interpolate(coupler_,
                         on_grid_nodes(coupler_, box,
                                       [&](const Vector& x) {
                                         Vector u = times(a, x);
                                         for (int c = 0; c < 3; ++c) u[c] += 0.75 - c;
                                         return u;
                                       }),
                         {300});
    };
    const Numbers with = velocity(length), without = velocity(0);
    double largest = 0;
    for (std::size_t k = 0; k < with.size(); ++k) largest = std::max(largest, std::abs(with[k] - without[k]));
    return largest;
  };
  EXPECT_LE(change({}), 2 * bound_of_unit_field);
  // Rotations: |u| <= 25. Of cosine4 the slopes along different axes differ by 0.2 of a turning of 0.9.
  if (GetParam().first_moment) {
    EXPECT_LE(change(rotation), 25 * bound_of_unit_field);
  } else {
    EXPECT_GT(change(rotation), 0.01);
  }
}

/// A sphere whose nodes are at least 1/64 away from the kinks of all kernels.
Sheared off_kinks() {
  Sheared sheared;
  const Vector centre = {11.0, 9.0, 12.0};
  Numbers nodes = sphere(100, 5.5, centre);
  for (double& x : nodes) x = (std::floor(32 * x) + 0.5) / 32;
  sheared.add(nodes, centre, length);
  return sheared;
}

// G by differences of what nodes without a dipole get, of any field. Over h = 2^-12 they are off by h^2/6 of
// the third derivative, of roma3 at most 144 a point; three points an axis, of a field below 1, and six such
// slopes: 6 * 3 * 144 * 1e-8 * 0.3 = 8e-6.
TEST_P(CouplerDipoles, AddTheShearOfAnyFieldByTheDerivativesOfTheVelocity) {
  constexpr double h = 1.0 / 4096.0;
  const Sheared sheared = off_kinks();
  const Numbers field = random_numbers(3 * n_box_nodes, -1, 1, 1);
  const auto plain = [&](const Numbers& nodes) {
    build(coupler_, std::vector<Numbers>{nodes});
    return interpolate(coupler_, picked(coupler_, field), {100});
  };
  const Numbers without = plain(sheared.nodes[0]);
  std::array<Numbers, 3> above, below;
  for (int axis = 0; axis < 3; ++axis) {
    above[axis] = plain(shifted(sheared.nodes[0], axis, h));
    below[axis] = plain(shifted(sheared.nodes[0], axis, -h));
  }
  build(coupler_, sheared);
  const Numbers with = interpolate(coupler_, picked(coupler_, field), {100});
  double largest = 0;
  for (std::size_t k = 0; k < with.size(); k += 3) {
    Matrix g;
    for (int c = 0; c < 3; ++c)
      for (int j = 0; j < 3; ++j) g[c][j] = (above[j][k + c] - below[j][k + c]) / (2 * h);
    const Vector shear = shear_of(g, &sheared.normals[0][k]);
    for (int c = 0; c < 3; ++c) {
      ASSERT_NEAR(with[k + c], without[k + c] + length * shear[c], 8e-6) << k;
      largest = std::max(largest, std::abs(length * shear[c]));
    }
  }
  EXPECT_GT(largest, 0.1);
}

// Both sums have 300 * 216 terms of weights whose sizes add up to 8.2 a node and 0.3 * 6 times that of the
// dipole: 300 * 23 in all, each term rounded at random (sqrt(6e4) = 250), or by 132 eps.
constexpr double sum_bound = 300 * 23 * (132 + 250) * eps;

TEST_P(CouplerDipoles, ConservePowerBothWays) {
  build(coupler_, one_sphere());
  for (const unsigned seed : {2u, 3u, 4u}) {
    const Numbers force = random_numbers(900, -1, 1, seed);
    const Numbers field = random_numbers(3 * coupler_.grid_nodes().size(), -1, 1, 10 + seed);
    const double of_membrane = dot(force, interpolate(coupler_, field, {300}));
    EXPECT_NEAR(dot(spread(coupler_, {force}), field), of_membrane, sum_bound) << seed;
    EXPECT_GT(std::abs(of_membrane), 1e4 * sum_bound);
  }
}

TEST_P(CouplerDipoles, ConserveForceAndWithTheFirstMomentTorque) {
  const Sheared sheared = one_sphere();
  const Numbers force = random_numbers(900, -1, 1, 5);
  build(coupler_, sheared);
  const Numbers grid_force = spread(coupler_, {force});
  Vector force_difference = {}, torque_difference = {};
  const auto add = [&](const Vector& x, const double* f, double sign) {
    for (int axis = 0; axis < 3; ++axis) {
      const int next = (axis + 1) % 3, last = (axis + 2) % 3;
      force_difference[axis] += sign * f[axis];
      torque_difference[axis] += sign * (x[next] * f[last] - x[last] * f[next]);
    }
  };
  for (std::size_t k = 0; k < coupler_.grid_nodes().size(); ++k)
    add(position_of(box, coupler_.grid_nodes()[k]), &grid_force[3 * k], 1);
  for (std::size_t k = 0; k < force.size(); k += 3) {
    const double* x = &sheared.nodes[0][k];
    add({x[0], x[1], x[2]}, &force[k], -1);
  }
  double largest = 0;
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(force_difference[axis], 0, sum_bound);
    largest = std::max(largest, std::abs(torque_difference[axis]));
  }
  // Arms of up to 24, two terms a component; without the first moment as without a dipole, random arms of
  // 0.015 times sqrt(600) forces of 0.58.
  if (GetParam().first_moment) {
    EXPECT_LE(largest, 48 * sum_bound);
  } else {
    EXPECT_GT(largest, 0.015);
  }
}

// By the definition the dipole of a force is that of its part along the surface.
TEST_P(CouplerDipoles, SpreadForcesAlongTheNormalAsWithoutThem) {
  Sheared sheared = one_sphere();
  const Numbers force = sheared.normals[0];
  build(coupler_, sheared);
  const Numbers with = spread(coupler_, {force});
  build(coupler_, sheared.nodes);
  const Numbers without = spread(coupler_, {force});
  // Up to 20 nodes at a grid node, the force of whose dipoles is rounding of their tangential part, 2 eps.
  for (std::size_t k = 0; k < with.size(); ++k) ASSERT_NEAR(with[k], without[k], 20 * 132 * eps) << k;
}

}  // namespace
}  // namespace tanktread::coupler::dipole_test
