// A flat sheet between two walls that pushes the fluid along itself: the velocity of its nodes, without and
// with the tangential correction, against the exact one.
#include <gtest/gtest.h>

#include "coupler/tangential_correction.hpp"
#include "tests/unit/coupler_moments.hpp"
#include "tests/unit/coupler_support.hpp"

namespace tanktread::coupler {
namespace {

using namespace test;

constexpr double viscosity = 1.0 / 6.0, force_per_area = 0.3;
constexpr int nodes_across = 8;  // of the box, along x and y

/// Nodes half a grid step apart in the plane z.
Numbers sheet(double z) {
  Numbers nodes;
  for (int j = 0; j < 2 * nodes_across; ++j) {
    for (int i = 0; i < 2 * nodes_across; ++i) nodes.insert(nodes.end(), {0.5 * i + 0.1, 0.5 * j + 0.2, z});
  }
  return nodes;
}

/// The steady flow along x under a force that depends on z alone: -mu u'' = F on the grid, with walls at rest
/// half a step outside the first and last node. Gauss elimination of the three diagonals.
Numbers flow_under(const Numbers& force) {
  const std::size_t n = force.size();
  Numbers diagonal(n, 2.0), right(n), velocity(n);
  diagonal.front() = diagonal.back() = 3.0;  // the node beyond the wall has the opposite velocity
  for (std::size_t k = 0; k < n; ++k) right[k] = force[k] / viscosity;
  for (std::size_t k = 1; k < n; ++k) {
    diagonal[k] -= 1.0 / diagonal[k - 1];
    right[k] += right[k - 1] / diagonal[k - 1];
  }
  for (std::size_t k = n; k-- > 0;)
    velocity[k] = (right[k] + (k + 1 < n ? velocity[k + 1] : 0.0)) / diagonal[k];
  return velocity;
}

struct SheetVelocity {
  double exact, interpolated, corrected;
};

/// Of the sheet at z in a channel of that height, in units of force_per_area/viscosity.
SheetVelocity sheet_velocity(const Kernel& kernel, int height, double z) {
  const Grid grid = {{nodes_across, nodes_across, height}, {true, true, false}};
  const Numbers nodes = sheet(z);
  Numbers force, normals;
  for (std::size_t k = 0; k < nodes.size() / 3; ++k) {
    force.insert(force.end(), {0.25 * force_per_area, 0, 0});
    normals.insert(normals.end(), {0, 0, 1});
  }
  Coupler coupler(grid, kernel, 1);
  build(coupler, {nodes});
  const Numbers spread_force = unpicked(coupler, grid, spread(coupler, {force}));
  Numbers along_z(height);
  for (int k = 0; k < height; ++k)
    along_z[k] = spread_force[3 * std::size_t{nodes_across} * nodes_across * k];
  const Numbers profile = flow_under(along_z);
  const auto grid_velocity = on_grid_nodes(coupler, grid, [&](const Vector& position) {
    return Vector{profile[static_cast<std::size_t>(position[2])], 0, 0};
  });
  Numbers velocity = interpolate(coupler, grid_velocity, {nodes.size() / 3});
  const double interpolated = velocity[0];
  const std::span<const double> normal(normals), pushing(force);
  const std::span<double> target(velocity);
  TangentialCorrection(coupler, viscosity).add(coupler, {&normal, 1}, {&pushing, 1}, {&target, 1});
  const double unit = force_per_area / viscosity;
  return {z * (height - z) / height, interpolated / unit, velocity[0] / unit};
}

class SheetKernels : public ::testing::TestWithParam<Kernel> {};
INSTANTIATE_TEST_SUITE_P(All, SheetKernels, ::testing::ValuesIn(kernels()),
                         [](const auto& tested) { return tested.param.name; });

/// The sheet stands within half a grid step of the middle, where the slope of the velocity that meets the
/// first moment of a kernel is below 1/16. Half a grid step between nodes makes an even sheet: two combs of
/// whole steps, each even by the partition of unity.
double first_moment_error(const Moments& known) {
  return known.first_moment / 16;
}

/// Means over the phases of what is missing, in grid steps.
struct Missing {
  double interpolated = 0, corrected = 0, largest_corrected = 0;
};
Missing missing(const Kernel& kernel, int height) {
  constexpr int n_phases = 64;
  Missing result;
  for (int phase = 0; phase < n_phases; ++phase) {
    const auto found = sheet_velocity(kernel, height, height / 2 + (phase + 0.5) / n_phases - 0.5);
    result.interpolated += (found.exact - found.interpolated) / n_phases;
    result.corrected += (found.exact - found.corrected) / n_phases;
    result.largest_corrected = std::max(result.largest_corrected, std::abs(found.exact - found.corrected));
  }
  return result;
}

// The same share of a grid step is missing in a channel of 16 steps and of 32: an error of first order. What
// the correction leaves is nothing in the mean over the phases, and so of no order. The midpoint rule over 64
// phases: the second derivative of s (1 - s) and of the sum of squares of linear2, the largest, make 3 at
// most: 3/(24 64^2) = 3e-5.
TEST_P(SheetKernels, FallShortByAShareOfAGridStepWhichTheCorrectionGivesBack) {
  const auto* known = known_moments_of(GetParam());
  ASSERT_NE(known, nullptr);
  const double bound = first_moment_error(*known) + 4e-5;
  for (const int height : {16, 32}) {
    const auto found = missing(GetParam(), height);
    EXPECT_NEAR(found.interpolated, known->shortfall, bound) << height;
    EXPECT_NEAR(found.corrected, 0, bound) << height;
  }
}

// At one phase: the sum of the pairs of cosine4 and peskin4 is 3/8 on a node (weights 1/4, 1/2, 1/4) and
// 0.3857 half-way between two, and their means are 0.3806 and 0.3810: at most 0.0060 off.
TEST(Sheet, IsRightAtEveryPhaseWithTheKernelsOfFourPoints) {
  for (const char* name : {"cosine4", "peskin4"}) {
    const double bound = 0.0061 + first_moment_error(*known_moments_of(kernel(name)));
    EXPECT_LT(missing(kernel(name), 16).largest_corrected, bound) << name;
  }
}

}  // namespace
}  // namespace tanktread::coupler
