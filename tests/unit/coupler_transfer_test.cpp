// Spread and interpolate: against plain sums over the whole grid, and what they conserve.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/unit/coupler_moments.hpp"
#include "tests/unit/coupler_support.hpp"

namespace tanktread::coupler {
namespace {

using namespace test;

const Grid periodic_box = {{24, 20, 22}, {true, true, true}};
constexpr std::size_t n_box_nodes = 24 * 20 * 22;

/// Two surfaces, the second across three periodic faces.
const std::vector<Numbers> two_surfaces = {sphere(300, 6.0, {11.0, 9.0, 12.0}),
                                           sphere(200, 4.5, {23.5, 0.3, 21.0})};

/// A six-point and a five-point raised cosine: kernels that a user might bring.
double cosine6(double r) {
  return std::abs(r) < 3.0 ? (1.0 + std::cos(std::numbers::pi * r / 3.0)) / 6.0 : 0.0;
}
double cosine5(double r) {
  return std::abs(r) < 2.5 ? (1.0 + std::cos(0.4 * std::numbers::pi * r)) / 5.0 : 0.0;
}

std::vector<Kernel> kernels_and_own() {
  auto all = kernels();
  all.push_back({"own5", "", 2.5, false, false, cosine5, nullptr});
  all.push_back({"own6", "", 3.0, false, false, cosine6, nullptr});
  return all;
}

/// delta(x_f - x_m) of Eq. 2.2 between one membrane node and every grid node, by the nearest periodic image.
class PlainDelta {
 public:
  PlainDelta(const Kernel& kernel, const double* position) {
    for (int axis = 0; axis < 3; ++axis)
      for (int index = 0; index < periodic_box.nodes[axis]; ++index)
        factor_[axis].push_back(
            kernel.function(std::remainder(position[axis] - (index + 0.5), periodic_box.nodes[axis])));
  }
  double operator()(std::int64_t node) const {
    const auto [i, j, k] = indices_of(periodic_box, node);
    return factor_[0][i] * factor_[1][j] * factor_[2][k];
  }

 private:
  std::array<Numbers, 3> factor_;
};

/// Those of all nodes of the two surfaces, in their order.
std::vector<PlainDelta> plain_deltas(const Kernel& kernel) {
  std::vector<PlainDelta> deltas;
  for (const auto& surface : two_surfaces)
    for (std::size_t start = 0; start < surface.size(); start += 3)
      deltas.emplace_back(kernel, &surface[start]);
  return deltas;
}

class CouplerTransfer : public ::testing::TestWithParam<Kernel> {
 protected:
  void SetUp() override { build(coupler_, two_surfaces); }

  Coupler coupler_{periodic_box, GetParam()};
  const std::vector<Numbers> force_ = {random_numbers(900, -1, 1, 3), random_numbers(600, -1, 1, 4)};
};

// Bounds below: a weight is a product of three kernel values, each right to 4 eps of at most 1: 12 eps. A sum
// of n such terms with |term| <= 1 in two different orders differs by at most 12 n eps + 2 n^2 eps / 2; as
// the weights of one stencil add up to 1, the first part is 12 * 216 eps at most (6-point kernels) and the
// second 216 eps.
constexpr double interpolation_bound = (12 + 1) * 216 * eps;

TEST_P(CouplerTransfer, InterpolatesAsThePlainSumOverAllGridNodes) {
  const Numbers field = random_numbers(3 * n_box_nodes, -1, 1, 5);
  const Numbers velocity = interpolate(coupler_, picked(coupler_, field), {300, 200});
  const auto deltas = plain_deltas(GetParam());
  for (std::size_t m = 0; m < deltas.size(); ++m) {
    Vector plain = {};
    for (std::size_t node = 0; node < n_box_nodes; ++node) {
      const double weight = deltas[m](node);
      for (int component = 0; component < 3; ++component)
        plain[component] += weight * field[3 * node + component];
    }
    for (int component = 0; component < 3; ++component)
      ASSERT_NEAR(velocity[3 * m + component], plain[component], interpolation_bound) << m;
  }
}

TEST_P(CouplerTransfer, SpreadsAsThePlainSumOverAllMembraneNodes) {
  const Numbers grid_force = unpicked(coupler_, periodic_box, spread(coupler_, force_));
  const Numbers force = joined(force_);
  const auto deltas = plain_deltas(GetParam());
  for (std::size_t node = 0; node < n_box_nodes; ++node) {
    Vector plain = {};
    double size = 0.0;  // sum of all weights: no partial sum is larger
    int n_terms = 0;
    for (std::size_t m = 0; m < deltas.size(); ++m) {
      const double weight = deltas[m](node);
      if (weight == 0.0) continue;
      size += weight;
      ++n_terms;
      for (int component = 0; component < 3; ++component)
        plain[component] += weight * force[3 * m + component];
    }
    // 12 eps a weight, as above, and a rounding of the sum with every addition, in either way of adding.
    const double bound = (12.0 + size) * n_terms * eps;
    for (int component = 0; component < 3; ++component)
      ASSERT_NEAR(grid_force[3 * node + component], plain[component], bound) << node;
  }
}

TEST_P(CouplerTransfer, PowerIsConserved) {
  // Positive numbers: nothing cancels, and the bound is one on the relative difference. About 500 * 64 terms
  // on one side, each rounded at random: sqrt(3e4) eps = 4e-14.
  const std::vector<Numbers> force = {random_numbers(900, 0.5, 1.5, 6), random_numbers(600, 0.5, 1.5, 7)};
  const Numbers grid_velocity = random_numbers(3 * coupler_.grid_nodes().size(), 0.5, 1.5, 8);
  const Numbers velocity = interpolate(coupler_, grid_velocity, {300, 200});
  const double membrane_power = dot(joined(force), velocity);
  EXPECT_NEAR(dot(spread(coupler_, force), grid_velocity) / membrane_power, 1.0, 1e-13);
  EXPECT_GT(membrane_power, 1500 * 0.25);
}

TEST_P(CouplerTransfer, TotalForceIsConserved) {
  Vector on_membrane = {}, on_grid = {};
  for (const auto& force : force_)
    for (std::size_t k = 0; k < force.size(); ++k) on_membrane[k % 3] += force[k];
  const Numbers grid_force = spread(coupler_, force_);
  for (std::size_t k = 0; k < grid_force.size(); ++k) on_grid[k % 3] += grid_force[k];
  // 500 forces of at most 1, each spread with weights whose sum is right to 3 * 16 eps; then the rounding of
  // sums of up to 1e4 terms, none of which is above 20 on the way: 1e4 * 20 eps / 2 if all went one way.
  for (int component = 0; component < 3; ++component)
    EXPECT_NEAR(on_grid[component], on_membrane[component], (500 * 48 + 1e5) * eps);
  EXPECT_GT(std::abs(on_membrane[0]), 1e-3);
}

TEST_P(CouplerTransfer, AConstantFieldIsFoundAgain) {
  const Numbers constant(3 * coupler_.grid_nodes().size(), 0.75);
  for (const double u : interpolate(coupler_, constant, {300, 200}))
    EXPECT_NEAR(u, 0.75, interpolation_bound);
}

TEST_P(CouplerTransfer, LinearFieldsAreExactJustWithTheFirstMoment) {
  const Numbers& surface = two_surfaces[0];  // across no face: a linear field has a jump there
  build(coupler_, {surface});
  const auto linear = [](const Vector& x) {
    return Vector{1.0 + 0.5 * x[0] - 0.25 * x[1] + 0.125 * x[2], x[1] - x[2], 2.0 - x[0]};
  };
  const Numbers velocity = interpolate(coupler_, on_grid_nodes(coupler_, periodic_box, linear), {300});
  double largest = 0.0;
  for (std::size_t m = 0; m < 300; ++m) {
    const Vector exact = linear({surface[3 * m], surface[3 * m + 1], surface[3 * m + 2]});
    for (int component = 0; component < 3; ++component)
      largest = std::max(largest, std::abs(velocity[3 * m + component] - exact[component]));
  }
  if (GetParam().first_moment) {
    EXPECT_LE(largest, 24 * interpolation_bound);  // values up to 24, else as for the plain sum
  } else {
    // The third component has the slope -1 along x and shows the first moment. It is flat at its worst phase
    // and 300 nodes come within 1/300 of it, or thereabouts: 5 % is ample. The second sums two axes.
    const double worst = largest_of_phases(GetParam(), first_moment);
    EXPECT_GT(largest, 0.95 * worst);
    EXPECT_LT(largest, 2.01 * worst);
  }
}

TEST_P(CouplerTransfer, TorqueIsConservedJustWithTheFirstMoment) {
  const Numbers& surface = two_surfaces[0];
  const Numbers& force = force_[0];
  build(coupler_, {surface});
  const Numbers grid_force = spread(coupler_, {force});
  Vector difference = {};
  const auto add_torque = [&](const double* x, const double* f, double sign) {
    for (int axis = 0; axis < 3; ++axis) {
      const int next = (axis + 1) % 3, last = (axis + 2) % 3;
      difference[axis] += sign * (x[next] * f[last] - x[last] * f[next]);
    }
  };
  for (std::size_t k = 0; k < coupler_.grid_nodes().size(); ++k)
    add_torque(position_of(periodic_box, coupler_.grid_nodes()[k]).data(), &grid_force[3 * k], 1.0);
  for (std::size_t m = 0; m < 300; ++m) add_torque(&surface[3 * m], &force[3 * m], -1.0);
  const double largest =
      std::max({std::abs(difference[0]), std::abs(difference[1]), std::abs(difference[2])});
  if (GetParam().first_moment) {
    // As for the total force, with arms of up to 24 and two terms a component.
    EXPECT_LE(largest, 2 * 24 * (300 * 48 + 1e5) * eps);
  } else {
    // 2 x 300 random arms of the size of the first moment times forces of 0.58 (r.m.s. of -1 .. 1) add up to
    // sqrt(600) 0.58 = 14 times the moment in each component; all three below 1 would be a chance of 2e-4.
    EXPECT_GT(largest, mean_square_root_of_phases(GetParam(), first_moment));
  }
}

TEST_P(CouplerTransfer, ASurfaceAcrossAPeriodicFaceIsAsInTheMiddle) {
  const Numbers surface = sphere(250, 5.0, {12.0, 10.0, 11.0});
  const Numbers force = random_numbers(750, -1, 1, 9);
  const Numbers field = random_numbers(3 * n_box_nodes, -1, 1, 10);
  Coupler across(periodic_box, GetParam());
  build(coupler_, {surface});
  const Numbers velocity = interpolate(coupler_, picked(coupler_, field), {250});
  const Numbers grid_force = unpicked(coupler_, periodic_box, spread(coupler_, {force}));
  for (int axis = 0; axis < 3; ++axis) {
    const int shift = periodic_box.nodes[axis] / 2;  // the centre comes to lie on the face
    const auto shifted_node = [&](std::int64_t node) {
      auto index = indices_of(periodic_box, node);
      index[axis] = (index[axis] + shift) % periodic_box.nodes[axis];
      return (std::int64_t{index[2]} * periodic_box.nodes[1] + index[1]) * periodic_box.nodes[0] + index[0];
    };
    Numbers shifted_field(field.size());
    for (std::size_t node = 0; node < n_box_nodes; ++node)
      std::copy_n(&field[3 * node], 3, &shifted_field[3 * shifted_node(node)]);
    build(across, {shifted(surface, axis, shift)});

    // The same products in the same order; only fused multiply-adds may come out differently.
    const Numbers shifted_velocity = interpolate(across, picked(across, shifted_field), {250});
    for (std::size_t k = 0; k < velocity.size(); ++k)
      ASSERT_NEAR(shifted_velocity[k], velocity[k], 216 * eps) << axis;
    const Numbers shifted_force = unpicked(across, periodic_box, spread(across, {force}));
    for (std::size_t node = 0; node < n_box_nodes; ++node)
      for (int component = 0; component < 3; ++component)
        ASSERT_NEAR(shifted_force[3 * shifted_node(node) + component], grid_force[3 * node + component],
                    250 * eps)
            << axis;
  }
}

INSTANTIATE_TEST_SUITE_P(All, CouplerTransfer, ::testing::ValuesIn(kernels_and_own()),
                         [](const auto& tested) { return tested.param.name; });

}  // namespace
}  // namespace tanktread::coupler
