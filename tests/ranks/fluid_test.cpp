// The fluid on several ranks is the fluid on one, to the last bit. Every rank computes the whole box as well.
#include <gtest/gtest.h>

#include "driver/system/halo_by_ranks.hpp"
#include "tests/ranks/world.hpp"
#include "tests/unit/fluid_parts.hpp"

namespace tanktread::ranks::test {
namespace {

using namespace fluid;
using namespace fluid::test;

LatticeBoltzmannSettings settings_of(Storage storage, int wall_axis) {
  LatticeBoltzmannSettings settings;
  settings.storage = storage;
  settings.shape = {24, 11, 9};
  if (wall_axis >= 0) settings.walls = moving_walls(wall_axis);
  settings.relaxation_time = 0.7;
  settings.threads = 1;
  return settings;
}

/// All divisions of the ranks: 8 of them in 10 ways.
std::vector<Division> divisions(const LatticeBoltzmannSettings& settings) {
  const auto& n = settings.shape;
  Box box{{n.nx, n.ny, n.nz}, {true, true, true}, {3, 1, 1}};
  if (settings.walls) box.periodic[settings.walls->axis] = false;
  std::vector<Division> found = {least_surface(box, all_ranks->size())};
  for (int x = 1; x <= all_ranks->size(); ++x)
    for (int y = 1; x * y <= all_ranks->size(); ++y)
      if (all_ranks->size() % (x * y) == 0)
        found.emplace_back(box, Triple{x, y, all_ranks->size() / (x * y)});
  return found;
}

class FluidOnRanks : public testing::TestWithParam<std::tuple<Storage, int>> {};
INSTANTIATE_TEST_SUITE_P(every, FluidOnRanks,
                         testing::Combine(testing::ValuesIn(storages), testing::Values(-1, 0, 1, 2)));

TEST_P(FluidOnRanks, is_the_fluid_on_one) {
  const auto settings = std::apply(settings_of, GetParam());
  for (const auto& division : divisions(settings)) {
    if (all_ranks->size() == 1) continue;  // the whole box has no halo
    const auto whole = make_lattice_boltzmann(settings);
    const auto part = driver::part_of(division, all_ranks->rank());
    const auto nodes = nodes_of(settings.shape, part);
    auto own =
        make_lattice_boltzmann(settings, part, std::make_unique<driver::HaloByRanks>(*all_ranks, division));
    disturb(*whole);
    own->restore(taken(whole->state(), nodes));
    for (int step = 0; step < 7; ++step) {
      const auto forces = some_forces(settings.shape, static_cast<unsigned>(step));
      const auto own_forces = taken(forces, nodes);
      whole->clear_force();
      own->clear_force();
      whole->add_force(forces.nodes, forces.force);
      own->add_force(own_forces.nodes, own_forces.force);
      EXPECT_EQ(all_ranks->highest(own->step()), whole->step());
      EXPECT_EQ(difference(own->state(), taken(whole->state(), nodes)), "") << "after step " << step;
      if (step % 3 == 1) {
        EXPECT_TRUE(said(*own) == taken(said(*whole), nodes)) << "after step " << step;
      }
    }
    said(*own);  // receives what is under way, so that all end together
  }
}

}  // namespace
}  // namespace tanktread::ranks::test
