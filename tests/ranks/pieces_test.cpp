// A fluid in pieces, on any number of ranks: what is written and read, and what is in memory meanwhile.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>

#include "driver/system/fluid_pieces.hpp"
#include "driver/system/halo_by_ranks.hpp"
#include "driver/system/state_from_pieces.hpp"
#include "exchange/vtk_files.hpp"
#include "tests/ranks/world.hpp"
#include "tests/unit/fluid_parts.hpp"

namespace tanktread::driver::test {
namespace {

using fluid::Layers;
using fluid::State;
using ranks::test::all_ranks;
using Nodes = std::vector<std::int64_t>;

constexpr fluid::GridShape box = {12, 7, 9};

/// A part that is asked for layers, and never for all at once.
class InLayers final : public fluid::Fluid {
 public:
  explicit InLayers(std::unique_ptr<fluid::Fluid> fluid) : fluid_(std::move(fluid)) {}
  ~InLayers() override { fluid_->free_velocity({}, {}, {}); }  // takes in what is under way. Together
  InLayers(const InLayers&) = delete;
  InLayers& operator=(const InLayers&) = delete;

  fluid::GridShape shape() const override { return fluid_->shape(); }
  void velocity(std::span<const std::int64_t>, std::span<double>) const override { refuse(); }
  void free_velocity(std::span<const std::int64_t>, std::span<double>, std::span<double>) const override {
    refuse();
  }
  void dissipation(std::span<double>) const override { refuse(); }
  void wall_power(std::span<double>) const override { refuse(); }
  void moments(std::span<double>, std::span<double>) const override { refuse(); }
  void moments_of_layers(Layers layers, std::span<double> density,
                         std::span<double> velocity) const override {
    fluid_->moments_of_layers(layers, density, velocity);
  }
  void add_force(std::span<const std::int64_t>, std::span<const double>) override { refuse(); }
  void clear_force() override { refuse(); }
  std::span<const double> force() const override { return fluid_->force(); }
  void set_viscosity(std::span<const double>) override { refuse(); }
  void set_viscosity(std::span<const std::int64_t>, std::span<const double>) override { refuse(); }
  double step() override { return fluid_->step(); }
  State state() const override { refuse(); }
  fluid::StateShape state_shape() const override { return fluid_->state_shape(); }
  void state_of_layers(const std::string& array, Layers layers, std::span<double> values) const override {
    fluid_->state_of_layers(array, layers, values);
  }
  void restore(const State&) override { refuse(); }
  void restore_from(const fluid::StateSource& state) override {
    if (cannot_restore) throw std::invalid_argument("this part cannot");
    fluid_->restore_from(state);
  }

  const fluid::Fluid& inner() const { return *fluid_; }
  bool cannot_restore = false;

 private:
  [[noreturn]] static void refuse() {
    throw std::logic_error("asked for all at once, or for what no file has");
  }

  std::unique_ptr<fluid::Fluid> fluid_;
};

fluid::LatticeBoltzmannSettings settings() {
  fluid::LatticeBoltzmannSettings settings;
  settings.shape = box;
  settings.threads = 1;
  return settings;
}

/// Every way to cut the box among the ranks.
std::vector<ranks::Division> divisions() {
  std::vector<ranks::Division> found;
  const int n = all_ranks->size();
  for (int x = 1; x <= std::min(n, box.nx / 3); ++x)  // a part has three nodes along x
    for (int y = 1; x * y <= n; ++y)
      if (n % (x * y) == 0)
        found.push_back({{{box.nx, box.ny, box.nz}, {true, true, true}, {3, 1, 1}}, {x, y, n / (x * y)}});
  return found;
}

/// A folder of all ranks, which is gone afterwards.
class SharedFolder {
 public:
  SharedFolder() {
    const std::vector<double> own = {static_cast<double>(::getpid())};
    const auto first = static_cast<long>(all_ranks->all_numbers(own)[0]);
    path_ = std::filesystem::temp_directory_path() / ("tanktread-ranks-pieces-" + std::to_string(first));
    std::filesystem::create_directories(path_);
    all_ranks->wait_for_all();
  }
  ~SharedFolder() {
    all_ranks->wait_for_all();
    std::error_code ignored;
    if (all_ranks->is_first()) std::filesystem::remove_all(path_, ignored);
  }
  std::filesystem::path operator/(const char* name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

/// The whole box on each rank, and its part of it.
struct Divided {
  explicit Divided(const ranks::Division& cuts)
      : division(cuts), whole(fluid::make_lattice_boltzmann(settings())), own(make_part()) {
    nodes = fluid::test::nodes_of(box, part_of(division, all_ranks->rank()));
  }
  InLayers make_part() const {
    if (all_ranks->size() == 1) return InLayers(fluid::make_lattice_boltzmann(settings()));
    return InLayers(fluid::make_lattice_boltzmann(settings(), part_of(division, all_ranks->rank()),
                                                  std::make_unique<HaloByRanks>(*all_ranks, division)));
  }
  /// The first node has a viscosity of its own, so that most parts know of none.
  State flow() const {
    fluid::test::disturb(*whole);
    whole->set_viscosity(Nodes{0}, std::vector<double>{0.3});
    const auto forces = fluid::test::some_forces(box);
    whole->add_force(forces.nodes, forces.force);
    return whole->state();
  }
  State of_part(State of_box) const {
    auto part = fluid::test::taken(std::move(of_box), nodes);
    const auto& viscosity = fluid::test::array(part, "viscosity");
    if (std::ranges::all_of(viscosity, [](double x) { return x != 0.3; })) part.arrays.pop_back();
    return part;
  }
  FluidPart part() const { return {*all_ranks, division, own, fluid::viscosity_of(settings()), {}}; }
  void write(const PiecesOrder& what) const {
    const auto written = write_piece(part(), what);
    EXPECT_EQ(written.error, "");
    all_ranks->wait_for_all();
    if (all_ranks->is_first()) write_index(division, what, written);
    all_ranks->wait_for_all();
  }

  ranks::Division division;
  std::unique_ptr<fluid::Fluid> whole;
  InLayers own;
  Nodes nodes;
};

/// A state that is in memory as a whole.
class Whole final : public fluid::StateSource {
 public:
  Whole(const State& state, const fluid::GridShape& shape) : state_(state), n_a_layer_(shape.nx * shape.ny) {}
  fluid::StateShape shape() const override {
    fluid::StateShape shape{state_.step, {}};
    for (const auto& array : state_.arrays) shape.arrays.push_back({array.name, array.components});
    return shape;
  }
  void read(const std::string& name, Layers layers, std::span<double> values) const override {
    const auto found = std::ranges::find(state_.arrays, name, &fluid::StateArray::name);
    std::copy_n(found->values.begin() + found->components * n_a_layer_ * layers.begin, values.size(),
                values.begin());
  }

 private:
  const State& state_;
  std::ptrdiff_t n_a_layer_;
};

const Ranges3 all = {{{0, box.nx - 1}, {0, box.ny - 1}, {0, box.nz - 1}}};

TEST(FluidPieces, of_a_state_are_the_state) {
  const SharedFolder folder;
  for (const auto& division : divisions()) {
    Divided divided(division);
    const auto state = divided.flow();
    const auto of_part = divided.of_part(state);
    divided.own.restore_from(Whole(of_part, divided.own.shape()));
    divided.write({folder / "state.pvti", all, true, state.step, 0});
    if (all_ranks->is_first()) {
      const auto file = exchange::read_grid(folder / "state.pvti");
      ASSERT_EQ(file.point_data.size(), state.arrays.size());
      for (std::size_t k = 0; k < state.arrays.size(); ++k)
        EXPECT_EQ(file.point_data[k].values, state.arrays[k].values) << state.arrays[k].name;
    }
    auto fresh = divided.make_part();
    const auto answer = restore_part(*all_ranks, fresh, division, folder / "state.pvti");
    EXPECT_EQ(answer.error, "");
    EXPECT_EQ(fluid::test::difference(fresh.inner().state(), fluid::test::taken(state, divided.nodes)), "");
    fresh.step();  // with what has come from the neighbours
    divided.own.step();
    divided.whole->step();
    EXPECT_EQ(fluid::test::difference(fresh.inner().state(),
                                      fluid::test::taken(divided.whole->state(), divided.nodes)),
              "");
    all_ranks->wait_for_all();
  }
}

TEST(FluidPieces, of_a_flow_are_the_flow) {
  const SharedFolder folder;
  for (const auto& division : divisions()) {
    Divided divided(division);
    const auto state = divided.flow();
    divided.own.restore_from(Whole(divided.of_part(state), divided.own.shape()));
    divided.write({folder / "flow.pvti", all, false, 0, 0.5});
    if (!all_ranks->is_first()) continue;
    const auto file = exchange::read_grid(folder / "flow.pvti");
    const auto moments = fluid::test::moments(*divided.whole);
    EXPECT_EQ(exchange::find_array(file.point_data, "density", "").values, moments.density);
    EXPECT_EQ(exchange::find_array(file.point_data, "velocity", "").values, moments.velocity);
    EXPECT_EQ(exchange::find_array(file.point_data, "force", "").values, fluid::test::array(state, "force"));
  }
}

TEST(FluidPieces, that_one_rank_cannot_take_over_change_none) {
  const SharedFolder folder;
  for (const auto& division : divisions()) {
    Divided divided(division);
    const auto state = divided.flow();
    divided.own.restore_from(Whole(divided.of_part(state), divided.own.shape()));
    divided.write({folder / "state.pvti", all, true, state.step, 0});
    for (int rank = 0; rank < all_ranks->size(); ++rank) {
      auto fresh = divided.make_part();
      fresh.cannot_restore = rank == all_ranks->rank();
      const auto before = fresh.inner().state();
      const auto answer = restore_part(*all_ranks, fresh, division, folder / "state.pvti");
      EXPECT_EQ(answer.error, fresh.cannot_restore ? "this part cannot" : "");
      EXPECT_EQ(fluid::test::difference(fresh.inner().state(), before), "");
      fresh.step();  // no rank waits for another
      all_ranks->wait_for_all();
    }
  }
}

}  // namespace
}  // namespace tanktread::driver::test
