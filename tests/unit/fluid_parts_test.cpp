// A box in parts is the whole box, to the last bit, wherever it is cut.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <deque>
#include <iterator>

#include "fluid/part_sizes.hpp"
#include "tests/unit/fluid_parts.hpp"

namespace tanktread::fluid::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// Messages that have been sent, by the part that they go to and where it sees them come from.
using Post = std::map<std::pair<int, std::array<int, 3>>, std::deque<std::vector<std::byte>>>;

std::array<int, 3> opposite(const std::array<int, 3>& direction) {
  return {-direction[0], -direction[1], -direction[2]};
}

/// An exchange within one program.
class PostExchange final : public HaloExchange {
 public:
  PostExchange(Post& post, const Cuts& cuts, int part) : post_(post), cuts_(cuts), part_(part) {}

  void connect(std::span<const HaloMessage> messages) override {
    messages_.assign(messages.begin(), messages.end());
  }
  void start() override {
    for (const auto& message : messages_) {
      auto& box = post_[{neighbour_of(cuts_, part_, message.direction), opposite(message.direction)}];
      box.emplace_back(message.outgoing.begin(), message.outgoing.end());
      EXPECT_LE(box.size(), 2u) << "more than one message waits for one that is still to be read";
    }
  }
  void finish() override {
    for (const auto& message : messages_) {
      auto& box = post_[{part_, message.direction}];
      ASSERT_FALSE(box.empty()) << "part " << part_ << " waits for what was never sent";
      ASSERT_EQ(box.front().size(), message.incoming.size());
      std::copy(box.front().begin(), box.front().end(), message.incoming.begin());
      box.pop_front();
    }
  }

 private:
  Post& post_;
  const Cuts& cuts_;
  int part_;
  std::vector<HaloMessage> messages_;
};

/// All parts of a box, one after the other.
struct Parts {
  Parts(const LatticeBoltzmannSettings& settings, const Cuts& where) : box(settings.shape), cuts(where) {
    for (int part = 0; part < n_parts(cuts); ++part) {
      nodes.push_back(nodes_of(box, part_of(cuts, part)));
      fluids.push_back(make_lattice_boltzmann(settings, part_of(cuts, part),
                                              std::make_unique<PostExchange>(post, cuts, part)));
    }
  }
  void restore(const State& state) {
    for (std::size_t k = 0; k < fluids.size(); ++k) fluids[k]->restore(taken(state, nodes[k]));
  }
  /// All numbers of the states are those of the whole box.
  void expect(const State& whole, const std::string& when) const {
    for (std::size_t k = 0; k < fluids.size(); ++k)
      EXPECT_EQ(difference(fluids[k]->state(), taken(whole, nodes[k])), "") << "part " << k << " " << when;
  }

  GridShape box;
  Cuts cuts;
  Post post;
  std::vector<std::unique_ptr<Fluid>> fluids;
  std::vector<std::vector<std::int64_t>> nodes;  ///< of the box, for each part
};

struct Division {
  GridShape box;
  Cuts cuts;
};
void PrintTo(const Division& division, std::ostream* out) {
  *out << division.box.nx << " x " << division.box.ny << " x " << division.box.nz << " in "
       << division.cuts[0].size() - 1 << " x " << division.cuts[1].size() - 1 << " x "
       << division.cuts[2].size() - 1;
}

// Two parts (each the other's neighbour on both sides), three, parts of one node, of unequal lengths; along
// one axis, two and three; rows of less than a pack, of whole packs and of a remainder.
const Division divisions[] = {
    {{27, 7, 6}, {{{0, 27}, {0, 7}, {0, 3, 6}}}},
    {{27, 7, 6}, {{{0, 27}, {0, 7}, {0, 1, 2, 6}}}},
    {{27, 7, 6}, {{{0, 27}, {0, 2, 3, 7}, {0, 6}}}},
    {{27, 7, 6}, {{{0, 27}, {0, 4, 7}, {0, 2, 6}}}},
    {{27, 7, 6}, {{{0, 16, 27}, {0, 7}, {0, 6}}}},
    {{9, 5, 4}, {{{0, 3, 6, 9}, {0, 5}, {0, 4}}}},
    {{27, 5, 4}, {{{0, 3, 24, 27}, {0, 5}, {0, 2, 4}}}},
    {{40, 5, 4}, {{{0, 16, 40}, {0, 2, 5}, {0, 3, 4}}}},
    {{18, 3, 3}, {{{0, 7, 18}, {0, 1, 2, 3}, {0, 1, 2, 3}}}},
};

/// A division of a box; in each test with every storage, and walls across no axis and each.
class FluidParts : public testing::TestWithParam<Division> {
 protected:
  static LatticeBoltzmannSettings settings(Storage storage, int wall_axis) {
    LatticeBoltzmannSettings settings;
    settings.storage = storage;
    settings.shape = GetParam().box;
    if (wall_axis >= 0) settings.walls = moving_walls(wall_axis);
    if (wall_axis >= 0) settings.start = Start::developed;
    settings.relaxation_time = 0.7;
    settings.body_force = {0, 0, 0};  // so that nodes without a force take their own way
    settings.threads = 1;
    return settings;
  }

  template <class Body>
  static void for_each_flow(const Body& body) {
    for (const Storage storage : storages) {
      for (const int wall_axis : {-1, 0, 1, 2}) {
        SCOPED_TRACE(name_of(storage) + ", walls across " + std::to_string(wall_axis));
        body(settings(storage, wall_axis));
      }
    }
  }
};

INSTANTIATE_TEST_SUITE_P(every, FluidParts, testing::ValuesIn(divisions));

// Forces that change every step, a viscosity a node, populations far from equilibrium. What the solvers say
// is asked for after some of the steps only, so that messages are received by a step and by a question.
void compare_with_whole(const Division& division, const LatticeBoltzmannSettings& settings) {
  const auto whole = make_lattice_boltzmann(settings);
  auto of_parts = settings;
  of_parts.threads = 2;
  Parts parts(of_parts, division.cuts);
  parts.expect(whole->state(), "at the start");
  disturb(*whole);
  parts.restore(whole->state());
  const auto viscosity = random_viscosity(division.box);
  whole->set_viscosity(viscosity);
  for (std::size_t k = 0; k < parts.fluids.size(); ++k)
    parts.fluids[k]->set_viscosity(taken(viscosity, 1, parts.nodes[k]));

  for (int step = 0; step < 9; ++step) {
    const auto forces = some_forces(division.box, static_cast<unsigned>(step));
    whole->clear_force();
    whole->add_force(forces.nodes, forces.force);
    const double highest_speed = whole->step();
    const auto state = whole->state();
    const bool asks = step % 3 != 0;
    const auto expected = asks ? said(*whole) : Said{};
    double highest_of_parts = 0.0;
    for (std::size_t k = 0; k < parts.fluids.size(); ++k) {
      auto& fluid = *parts.fluids[k];
      fluid.clear_force();
      const auto own = taken(forces, parts.nodes[k]);
      fluid.add_force(own.nodes, own.force);
      highest_of_parts = std::max(highest_of_parts, fluid.step());
    }
    EXPECT_EQ(highest_of_parts, highest_speed);
    parts.expect(state, "after step " + std::to_string(step));
    for (std::size_t k = 0; asks && k < parts.fluids.size(); ++k)
      EXPECT_TRUE(said(*parts.fluids[k]) == taken(expected, parts.nodes[k])) << "part " << k;
  }
}

TEST_P(FluidParts, are_the_whole_box) {
  for_each_flow([](const LatticeBoltzmannSettings& settings) { compare_with_whole(GetParam(), settings); });
}

// A state of the whole box, after either turn, goes on in parts, in the middle of an exchange too.
void go_on_from_whole(const Division& division, const LatticeBoltzmannSettings& settings) {
  for (const int n_before : {4, 5}) {
    const auto whole = make_lattice_boltzmann(settings);
    disturb(*whole);
    steps(*whole, n_before);
    Parts parts(settings, division.cuts);
    for (auto& fluid : parts.fluids) fluid->step();
    parts.restore(whole->state());
    for (int step = 0; step < 3; ++step) {
      whole->step();
      for (auto& fluid : parts.fluids) fluid->step();
    }
    parts.expect(whole->state(), "three steps later");
  }
}

TEST_P(FluidParts, go_on_from_a_state_of_the_whole_box) {
  for_each_flow([](const LatticeBoltzmannSettings& settings) { go_on_from_whole(GetParam(), settings); });
}

// A part that breaks down has sent what its neighbours wait for: they end the step, and so all can be
// restored.
void break_one_down(const Division& division, const LatticeBoltzmannSettings& settings) {
  const auto whole = make_lattice_boltzmann(settings);
  Parts parts(settings, division.cuts);
  for (const int n_before : {0, 1}) {
    for (std::size_t k = 0; k < parts.fluids.size(); ++k) {
      auto& fluid = *parts.fluids[k];
      for (int step = 0; step < n_before; ++step) fluid.step();
    }
    parts.fluids.back()->add_force(std::vector<std::int64_t>{0}, Numbers{0, 1.0, 0});
    for (auto& fluid : parts.fluids) {
      if (fluid == parts.fluids.back()) {
        EXPECT_THROW(fluid->step(), Breakdown);
      } else {
        fluid->step();
      }
    }
    disturb(*whole);
    parts.restore(whole->state());
    for (int step = 0; step < 3; ++step) {
      whole->step();
      for (auto& fluid : parts.fluids) fluid->step();
    }
    parts.expect(whole->state(), "three steps later");
  }
}

TEST_P(FluidParts, outlive_the_breakdown_of_one) {
  for_each_flow([](const LatticeBoltzmannSettings& settings) { break_one_down(GetParam(), settings); });
}

/// Tells what it was connected with, and carries nothing.
class SilentExchange final : public HaloExchange {
 public:
  explicit SilentExchange(std::vector<HaloMessage>& connected) : connected_(connected) {}
  void connect(std::span<const HaloMessage> messages) override {
    connected_.assign(messages.begin(), messages.end());
  }
  void start() override {}
  void finish() override {}

 private:
  std::vector<HaloMessage>& connected_;
};

// A plan knows the messages of a part without making it.
TEST_P(FluidParts, have_the_messages_that_are_foretold) {
  for_each_flow([](const LatticeBoltzmannSettings& settings) {
    const Cuts& cuts = GetParam().cuts;
    for (int number = 0; number < n_parts(cuts); ++number) {
      SCOPED_TRACE("part " + std::to_string(number));
      const auto part = part_of(cuts, number);
      std::vector<HaloMessage> connected;
      const auto fluid = make_lattice_boltzmann(settings, part, std::make_unique<SilentExchange>(connected));
      const auto sizes = part_sizes(settings, part);
      ASSERT_EQ(sizes.messages.size(), connected.size());
      std::int64_t bytes = 0;
      for (std::size_t k = 0; k < connected.size(); ++k) {
        EXPECT_EQ(sizes.messages[k].direction, connected[k].direction);
        EXPECT_EQ(sizes.messages[k].bytes, std::ssize(connected[k].outgoing));
        EXPECT_EQ(sizes.messages[k].bytes, std::ssize(connected[k].incoming));
        bytes += std::ssize(connected[k].outgoing);
      }
      EXPECT_EQ(sizes.message_bytes(), bytes);
    }
  });
}

// By hand, for a part of 16 x 4 x 3 nodes that is cut on all sides. Of the five links across a face four are
// slanted; each leaves over one edge, whose nodes have it as one link of that edge. A row of 16 doubles are
// two cache lines, and a line more at each end; 6 x 5 rows of four lines, and as many lines more as make 347
// = 256 + 91 of them.
TEST(FluidPartSizes, are_those_of_a_block) {
  LatticeBoltzmannSettings settings;
  settings.shape = {64, 16, 9};
  const auto sizes = part_sizes(settings, {{16, 4, 3}, {16, 4, 3}});
  EXPECT_EQ(sizes.nodes, 192);
  EXPECT_EQ(sizes.halo_nodes, 18 * 6 * 5 - 192);
  const auto face = [](int a, int b) { return 5 * a * b - 2 * a - 2 * b; };
  const std::map<std::array<int, 3>, std::int64_t> numbers = {
      {{1, 0, 0}, face(4, 3)}, {{0, -1, 0}, face(16, 3)}, {{0, 0, 1}, face(16, 4)},
      {{1, 1, 0}, 3},          {{-1, 0, 1}, 4},           {{0, 1, -1}, 16}};
  EXPECT_EQ(sizes.messages.size(), 18u);  // six faces, twelve edges
  for (const auto& [direction, bytes] : sizes.messages) {
    const auto found = numbers.find(direction);
    if (found == numbers.end()) continue;
    EXPECT_EQ(bytes, 8 * found->second) << direction[0] << direction[1] << direction[2];
  }
  EXPECT_EQ(sizes.message_bytes(), 8 * 2 * (face(4, 3) + face(16, 3) + face(16, 4)) + 8 * 4 * (3 + 4 + 16));
  EXPECT_EQ(sizes.population_bytes, 19 * 347 * 64);
  settings.storage = Storage::single_precision;
  EXPECT_EQ(part_sizes(settings, {{16, 4, 3}, {16, 4, 3}}).message_bytes(), sizes.message_bytes() / 2);
  EXPECT_THROW(part_sizes(settings, {{16, 4, 3}, {2, 4, 3}}), std::invalid_argument);
}

class FluidPartSettings : public testing::Test {
 protected:
  static LatticeBoltzmannSettings settings() {
    LatticeBoltzmannSettings settings;
    settings.shape = {19, 5, 4};
    settings.threads = 1;
    return settings;
  }
  static std::string refusal_of(const GridPart& part, bool with_exchange = true) {
    static Post post;
    static const Cuts cuts = {{{0, 19}, {0, 5}, {0, 2, 4}}};
    try {
      make_lattice_boltzmann(settings(), part,
                             with_exchange ? std::make_unique<PostExchange>(post, cuts, 0) : nullptr);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  }
};

TEST_F(FluidPartSettings, a_part_must_lie_in_the_box) {
  EXPECT_EQ(refusal_of({{0, 0, 2}, {19, 5, 2}}), "");
  EXPECT_THAT(refusal_of({{0, 0, 3}, {19, 5, 2}}),
              AllOf(HasSubstr("part.begin along z is 3"), HasSubstr("0 to 2")));
  EXPECT_THAT(refusal_of({{0, -1, 0}, {19, 2, 4}}),
              AllOf(HasSubstr("part.begin along y is -1"), HasSubstr("0 to 3")));
  EXPECT_THAT(refusal_of({{0, 0, 0}, {2, 5, 4}}),
              AllOf(HasSubstr("part.shape along x is 2"), HasSubstr("3 to 19")));
  EXPECT_THAT(refusal_of({{0, 0, 0}, {19, 6, 4}}),
              AllOf(HasSubstr("part.shape along y is 6"), HasSubstr("1 to 5")));
  EXPECT_THAT(refusal_of({{0, 0, 0}, {19, 5, 0}}),
              AllOf(HasSubstr("part.shape along z is 0"), HasSubstr("1 to 4")));
}

TEST_F(FluidPartSettings, a_part_and_an_exchange_belong_together) {
  EXPECT_THAT(refusal_of({{0, 0, 2}, {19, 5, 2}}, false), HasSubstr("needs an exchange"));
  EXPECT_THAT(refusal_of({{0, 0, 0}, {19, 5, 4}}, true), HasSubstr("nothing to exchange"));
  EXPECT_EQ(refusal_of({{0, 0, 0}, {19, 5, 4}}, false), "");
}

TEST_F(FluidPartSettings, a_breakdown_names_the_node_of_the_box) {
  Parts parts(settings(), {{{0, 8, 19}, {0, 1, 5}, {0, 2, 4}}});
  auto& last = *parts.fluids.back();
  last.add_force(std::vector{last.shape().index(3, 2, 1)}, Numbers{0, 1.0, 0});
  try {
    last.step();
    ADD_FAILURE() << "the step went on";
  } catch (const Breakdown& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("step 1:"), HasSubstr("(11, 3, 3)")));
  }
}

}  // namespace
}  // namespace tanktread::fluid::test
