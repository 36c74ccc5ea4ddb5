// A flat sheet between two fluids, along the grid: under a shear stress, and pushing the fluid along itself;
// without and with its shear dipole.
#include "coupler/two_fluids.hpp"

#include <gtest/gtest.h>

#include "coupler/tangential_correction.hpp"
#include "tests/unit/coupler_dipole_support.hpp"

namespace tanktread::coupler::two_fluids_test {
namespace {

using namespace test;

constexpr int nodes_across = 8, height = 24;  ///< of the box, along x and y; along z
constexpr int middle = height / 2;            ///< grid nodes below have the fluid inside (z points outwards)

/// Nodes half a grid step apart in the plane z: an even sheet, two combs of whole steps along x and y.
Sheared sheet(double z, double length) {
  Sheared sheared = {{{}}, {{}}, {length}};
  for (int j = 0; j < 2 * nodes_across; ++j) {
    for (int i = 0; i < 2 * nodes_across; ++i) {
      sheared.nodes[0].insert(sheared.nodes[0].end(), {0.5 * i + 0.1, 0.5 * j + 0.2, z});
      sheared.normals[0].insert(sheared.normals[0].end(), {0, 0, 1});
    }
  }
  return sheared;
}

/// The steady flow along x by forces that depend on z alone, and under the stress `top` beyond the highest
/// node: from one grid node to the next the velocity changes by the stress over the viscosity, of either node
/// half the way (harmonic mean). At rest at the lowest node.
Numbers flow(const SideViscosities& viscosities, const Numbers& force, double top) {
  Numbers stress(height), velocity(height);
  stress[height - 1] = top;
  for (int k = height - 1; k > 0; --k) stress[k - 1] = stress[k] + force[k];
  const auto viscosity = [&](int k) { return k < middle ? viscosities.inner : viscosities.outer; };
  for (int k = 1; k < height; ++k)
    velocity[k] = velocity[k - 1] + stress[k - 1] * (0.5 / viscosity(k - 1) + 0.5 / viscosity(k));
  return velocity;
}

/// The velocity of the sheet's nodes, and that of the flows on both sides, continued to the sheet.
struct AtSheet {
  double node = 0, outer = 0, inner = 0;
};

/// @param force an area, on the sheet at z
/// @param stress above the sheet
/// @param shortfall given back by the tangential correction
AtSheet at_sheet(const Kernel& kernel, const SideViscosities& viscosities, double length, double z,
                 double force, double stress, double shortfall) {
  const Grid grid = {{nodes_across, nodes_across, height}, {true, true, false}};
  const Sheared sheared = sheet(z, length);
  Coupler coupler(grid, kernel, 1);
  build(coupler, sheared);
  Numbers node_force(sheared.nodes[0].size());
  for (std::size_t k = 0; k < node_force.size(); k += 3) node_force[k] = 0.25 * force;
  const Numbers grid_force = unpicked(coupler, grid, spread(coupler, {node_force}));
  Numbers along_z(height);
  for (int k = 0; k < height; ++k) along_z[k] = grid_force[3 * std::size_t{nodes_across} * nodes_across * k];
  const Numbers profile = flow(viscosities, along_z, stress);
  Numbers velocity = interpolate(coupler,
                                 on_grid_nodes(coupler, grid,
                                               [&](const Vector& x) {
                                                 return Vector{profile[static_cast<std::size_t>(x[2])], 0, 0};
                                               }),
                                 sheared.sizes());
  if (shortfall > 0) {
    const std::span<const double> normals(sheared.normals[0]), pushing(node_force);
    const std::span<double> target(velocity);
    TangentialCorrection(coupler, TangentialCorrection::Shortfalls{{shortfall}})
        .add(coupler, {&normals, 1}, {&pushing, 1}, {&target, 1});
  }
  const double above = profile[height - 1] - (height - 0.5 - z) * (profile[height - 1] - profile[height - 2]);
  return {velocity[0], above, profile[0] + (z - 0.5) * (profile[1] - profile[0])};
}

/// Mean over the places of the sheet between the two grid nodes that the viscosity changes between.
AtSheet mean_at_sheet(const Kernel& kernel, const SideViscosities& viscosities, double length, double force,
                      double stress, double shortfall = 0) {
  constexpr int n_phases = 64;
  AtSheet mean;
  for (int phase = 0; phase < n_phases; ++phase) {
    const double z = middle - 0.5 + (phase + 0.5) / n_phases;
    const auto found = at_sheet(kernel, viscosities, length, z, force, stress, shortfall);
    mean.node += found.node / n_phases;
    mean.outer += found.outer / n_phases;
    mean.inner += found.inner / n_phases;
  }
  return mean;
}

/// m of a sheet along the grid. A velocity that grows by tau/mu_o above the point half-way between the two
/// grid nodes and by tau/mu_i below it gives the nodes (1/mu_o - 1/mu_i) tau times the sum over the grid
/// nodes above of their distance times the weight, beyond that of a linear one; in the mean over the places
/// the weight of the j-th is the integral of phi from j - 1 to j.
double distance_along_grid(const Kernel& kernel) {
  constexpr int cells = 4096;
  double sum = 0;
  for (int j = 1; j <= 3; ++j)
    for (int k = 0; k < cells; ++k) sum += (j - 0.5) * kernel.function(j - 1 + (k + 0.5) / cells) / cells;
  return sum;
}

/// What the dipole leaves of it: the nodes get the length times the slope of the velocity, whose mean over
/// the places is that of both sides (by the partition of unity). With d = 2 m (mu_o - mu_i)/(mu_o + mu_i) the
/// sum is (m_along_grid - m) (1/mu_o - 1/mu_i).
double rest(const Kernel& kernel, const SideViscosities& viscosities, double length) {
  const double outer = 1 / viscosities.outer, inner = 1 / viscosities.inner;
  return distance_along_grid(kernel) * (outer - inner) + 0.5 * length * (outer + inner);
}

const std::vector<SideViscosities> contrasts = {{0.2, 1.0}, {1.0, 0.2}, {0.5, 0.4}};

// The midpoint rule over N = 64 phases is off by at most 1/(8 N^2) = 3.1e-5 times the integral of the size of
// the second derivative. That of (j - 1/2) phi(s - j) is below 8 (roma3 near its kink, on 1/10 of the phases)
// and as a rule below 2; times up to 1/mu_i - 1/mu_o = 4 it makes 2.5e-4. Of the slopes of roma3 the second
// derivative is up to 144, with an integral of 16 (from 0 to -8 and back); times d (1/mu_o + 1/mu_i)/2 = 1.0
// another 5e-4.
constexpr double phases_bound = 8e-4;

class TwoFluidsSheet : public ::testing::TestWithParam<Kernel> {};
INSTANTIATE_TEST_SUITE_P(All, TwoFluidsSheet, ::testing::ValuesIn(kernels()),
                         [](const auto& tested) { return tested.param.name; });

// The sheet of the default has 0.2355 while the length goes by 0.1897, the mean over all directions.
TEST(TwoFluidsDefaultSheet, OfTheDefaultKernelKeepsAFifth) {
  const SideViscosities viscosities = {1.0, 0.2};
  const Kernel& first = kernels().front();
  const double without = rest(first, viscosities, 0),
               with = rest(first, viscosities, dipole_length(first, viscosities));
  EXPECT_NEAR(without / -4, 0.2355, 1e-4);
  EXPECT_NEAR(with / -4, 0.2355 - 0.1897, 2e-4);
}

TEST_P(TwoFluidsSheet, UnderAStressMovesByTheRestOfItsDipole) {
  constexpr double stress = 0.7;
  for (const auto& viscosities : contrasts) {
    const double d = dipole_length(GetParam(), viscosities);
    for (const double length : {0.0, d, -0.2}) {
      const auto found = mean_at_sheet(GetParam(), viscosities, length, 0, stress);
      const double expected = stress * rest(GetParam(), viscosities, length);
      EXPECT_NEAR(found.node - found.inner, expected, phases_bound) << viscosities.outer << " " << length;
      EXPECT_NEAR(found.node - found.outer, expected, phases_bound) << viscosities.outer << " " << length;
    }
    // Less than a third of it is left, of the same sign: the dipole is neither the wrong way nor too long.
    const double left = rest(GetParam(), viscosities, d) / rest(GetParam(), viscosities, 0);
    EXPECT_GT(left, 0.05);
    EXPECT_LT(left, 1.0 / 3);
  }
}

// With the stresses -f/2 above and f/2 below the sharp sheet has no stress in the mean: the same distances
// make the flows slip past each other, and the nodes fall short of the mean of both.
TEST_P(TwoFluidsSheet, ThatPushesMakesTheFluidsSlipByTheRestOfItsDipole) {
  constexpr double force = 0.6;
  for (const auto& viscosities : contrasts) {
    for (const double length : {0.0, dipole_length(GetParam(), viscosities), -0.2}) {
      const auto found = mean_at_sheet(GetParam(), viscosities, length, force, -0.5 * force);
      EXPECT_NEAR(found.outer - found.inner, force * rest(GetParam(), viscosities, length), phases_bound)
          << viscosities.outer << " " << length;
      const double shortfall = tangential_shortfall(GetParam(), viscosities, length);
      EXPECT_NEAR(0.5 * (found.outer + found.inner) - found.node, force * shortfall, phases_bound)
          << viscosities.outer << " " << length;
    }
  }
}

// The correction takes no stress: beside the shortfall the nodes keep the rest of the mean stress.
TEST_P(TwoFluidsSheet, IsRightButForTheRestWithTheCorrection) {
  constexpr double force = 0.6, stress = 0.4;  // above; 1.0 below, 0.7 in the mean
  for (const auto& viscosities : contrasts) {
    const double d = dipole_length(GetParam(), viscosities);
    const auto found = mean_at_sheet(GetParam(), viscosities, d, force, stress,
                                     tangential_shortfall(GetParam(), viscosities, d));
    EXPECT_NEAR(found.node - 0.5 * (found.outer + found.inner), 0.7 * rest(GetParam(), viscosities, d),
                2 * phases_bound)
        << viscosities.outer;
  }
}

}  // namespace
}  // namespace tanktread::coupler::two_fluids_test
