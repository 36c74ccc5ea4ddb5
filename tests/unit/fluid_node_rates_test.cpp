// Where a step loads the rates of each node, which no result shows.
#include "fluid/node_rates.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "fluid/settings.hpp"
#include "tests/unit/fluid_support.hpp"

namespace tanktread::fluid::test {
namespace {

/// A ball of one viscosity about a point of a box, as of a capsule.
std::vector<std::int64_t> ball(const GridShape& shape, double x_centre, double radius) {
  std::vector<std::int64_t> nodes;
  for_each_node(shape, [&](int x, int y, int z, std::int64_t node) {
    if (std::hypot(x + 0.5 - x_centre, y + 0.5 - 0.5 * shape.ny, z + 0.5 - 0.5 * shape.nz) < radius)
      nodes.push_back(node);
  });
  return nodes;
}

/// Packs that the border of the ball cuts, counted from outside.
std::int64_t cut_packs(const GridShape& shape, int size, const std::vector<std::int64_t>& inside) {
  std::vector<int> is_inside(shape.size());
  for (const auto node : inside) is_inside[node] = 1;
  std::int64_t n_cut = 0;
  for (std::int64_t row = 0; row < shape.size() / shape.nx; ++row) {
    for (int x = 0; x < shape.nx; x += size) {
      const int n = std::min(size, shape.nx - x);
      const int n_inside =
          std::accumulate(&is_inside[row * shape.nx + x], &is_inside[row * shape.nx + x] + n, 0);
      if (n_inside > 0 && n_inside < n) ++n_cut;
    }
  }
  return n_cut;
}

// What a contrast costs: a step loads rates from an array only where the border of a ball cuts a pack,
// wherever the ball has been before and whatever viscosities there were.
template <typename Real>
void expect_only_cut_packs_mixed(Storage storage) {
  LatticeBoltzmannSettings settings;
  settings.shape = {75, 20, 20};
  settings.relaxation_time = 0.7;
  settings.storage = storage;
  NodeRates<Real> rates(settings, settings.shape);
  EXPECT_EQ(rates.n_mixed(), 0);
  for (int step = 0; step < 100; ++step) {
    const std::vector<std::int64_t> nodes = ball(settings.shape, 10.0 + step % 50, 9.3);
    rates.set(nodes, Numbers(nodes.size(), 0.02 + 0.001 * step));
    EXPECT_EQ(rates.n_mixed(), cut_packs(settings.shape, pack_size<Real>, nodes)) << "step " << step;
    if (step < 50) {  // more of them than the table holds, each way
      rates.set(nodes, Numbers(nodes.size(), viscosity_of(settings)));
    } else {
      rates.set_all({});
    }
    EXPECT_EQ(rates.n_mixed(), 0);
  }
}
TEST(FluidNodeRates, are_mixed_only_where_the_border_of_a_ball_cuts_a_pack) {
  expect_only_cut_packs_mixed<double>(Storage::double_precision);
  expect_only_cut_packs_mixed<float>(Storage::single_precision);
}

}  // namespace
}  // namespace tanktread::fluid::test
