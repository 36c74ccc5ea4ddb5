// A plan for many ranks: its model in closed form, its messages against those of real parts.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <set>

#include "driver/plan/plan.hpp"
#include "driver/plan/rank_plan.hpp"
#include "driver/plan/rank_report.hpp"
#include "driver/plan/sample.hpp"
#include "driver/system/capsule_shape.hpp"
#include "driver/system/halo_by_ranks.hpp"
#include "driver/system/run_ranks.hpp"
#include "fluid/part_sizes.hpp"
#include "tests/unit/case_samples.hpp"

namespace tanktread::driver::rank_plan_test {
namespace {

using namespace tanktread::testing;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

RankSubject subject_of(const Case& the_case) {
  return rank_subject(the_case, parameters(the_case), sizes_of(membrane_shapes(the_case).meshes));
}

/// Seconds a node of fluid and membrane, a message, bytes a second: powers of two, so that sums are exact.
RankModel some_model() {
  return {.node_seconds = 0x1p-20,
          .membrane_node_seconds = 0x1p-14,
          .latency_seconds = 0x1p-10,
          .bytes_per_second = 0x1p20};
}

/// No capsule, and nothing that a message takes.
RankModel fluid_alone() {
  RankModel model;
  model.node_seconds = 1e-8;
  return model;
}

// A periodic cube of 32^3 in eight of 16^3. Of the five links across a face four leave over an edge each, but
// for those of 15 nodes in 16: 5 16^2 - 4 16 numbers; an edge has 16. Round the box both faces across an axis
// are of the same neighbour, and all four edges between two axes: six other ranks.
TEST(RankPlan, OfACubeIsInClosedForm) {
  const auto the_case = parse(droplet_case);
  const auto subject = subject_of(the_case);
  const auto model = some_model();
  const ranks::Division division(box_of_ranks(the_case), {2, 2, 2});
  const auto plan = rank_plan(subject, division, model);
  const std::int64_t face = 8 * (5 * 256 - 4 * 16), edge = 8 * 16;
  EXPECT_EQ(plan.n_ranks(), 8);
  EXPECT_EQ(plan.largest, (ranks::Triple{16, 16, 16}));
  EXPECT_EQ(plan.smallest, plan.largest);
  EXPECT_EQ(plan.halo_nodes, 18 * 18 * 18 - 16 * 16 * 16);
  EXPECT_EQ(plan.n_messages, 6 + 12);
  EXPECT_EQ(plan.n_neighbours, 3 + 3);
  EXPECT_EQ(plan.largest_message_bytes, face);
  EXPECT_EQ(plan.message_bytes, 6 * face + 12 * edge);
  EXPECT_EQ(plan.fluid_seconds, 4096 * 0x1p-20);
  EXPECT_EQ(plan.message_seconds, 18 * 0x1p-10 + static_cast<double>(6 * face + 12 * edge) * 0x1p-20);
  EXPECT_EQ(plan.membrane_seconds, 642 * 0x1p-14);
  EXPECT_DOUBLE_EQ(plan.efficiency,
                   (32768 * 0x1p-20 + 642 * 0x1p-14) /
                       (8 * (plan.fluid_seconds + plan.message_seconds + plan.membrane_seconds)));
  // Populations with their halo; messages out and in; force and state. A membrane node takes 1500 bytes.
  const auto populations = fluid::part_sizes(subject.fluid, part_of(division, 0)).population_bytes;
  EXPECT_GT(populations, 19 * 8 * 18 * 18 * 18);
  EXPECT_EQ(plan.fluid_memory_bytes, static_cast<double>(populations + 2 * plan.message_bytes) + 4096 * 200);
  EXPECT_EQ(plan.membrane_memory_bytes, 642 * 1500);
  EXPECT_EQ(plan.first_rank_bytes, 32768 * 176 + 2 * 370 * 1280);  // for files: the box; membranes, twice
}

/// Tells what it was connected with.
class Listener final : public fluid::HaloExchange {
 public:
  explicit Listener(std::vector<fluid::HaloMessage>& heard) : heard_(heard) {}
  void connect(std::span<const fluid::HaloMessage> messages) override {
    heard_.assign(messages.begin(), messages.end());
  }
  void start() override {}
  void finish() override {}

 private:
  std::vector<fluid::HaloMessage>& heard_;
};

/// What the solvers of all ranks announce.
struct Announced {
  int n_messages = 0, n_neighbours = 0;
  std::int64_t largest = 0, all = 0;
};
Announced announced(const RankSubject& subject, const ranks::Division& division) {
  Announced most;
  for (int rank = 0; rank < division.n_ranks(); ++rank) {
    std::vector<fluid::HaloMessage> heard;
    const auto part = fluid::make_lattice_boltzmann(subject.fluid, part_of(division, rank),
                                                    std::make_unique<Listener>(heard));
    std::int64_t bytes = 0;
    std::set<int> others;
    for (const auto& message : heard) {
      bytes += std::ssize(message.outgoing);
      most.largest = std::max(most.largest, std::int64_t{std::ssize(message.outgoing)});
      others.insert(division.neighbour(rank, message.direction).value());
    }
    others.erase(rank);
    most.n_messages = std::max(most.n_messages, static_cast<int>(heard.size()));
    most.n_neighbours = std::max(most.n_neighbours, static_cast<int>(others.size()));
    most.all = std::max(most.all, bytes);
  }
  return most;
}

// With walls and without, parts of unequal lengths, along one axis to three; all ranks, of which the plan
// looks at one of a kind.
TEST(RankPlan, HasTheMessagesOfRealParts) {
  for (const auto& the_case : {parse(least_case), parse(droplet_case, {"flow.storage=single"})}) {
    const auto subject = subject_of(the_case);
    for (const ranks::Triple& parts : {ranks::Triple{1, 1, 2}, {1, 1, 4}, {1, 3, 5}, {5, 1, 1}, {3, 4, 3}}) {
      SCOPED_TRACE(::testing::PrintToString(parts));
      const ranks::Division division(subject.box, parts);
      const auto plan = rank_plan(subject, division, some_model());
      const auto real = announced(subject, division);
      EXPECT_EQ(plan.n_messages, real.n_messages);
      EXPECT_EQ(plan.n_neighbours, real.n_neighbours);
      EXPECT_EQ(plan.largest_message_bytes, real.largest);
      EXPECT_EQ(plan.message_bytes, real.all);
      EXPECT_LE(kinds_of_parts(division).size(), 64u);
    }
  }
}

TEST(RankPlan, OfOneRankHasAnEfficiencyOfOne) {
  const auto subject = subject_of(parse(full_case));
  const auto plan = rank_plan(subject, ranks::least_surface(subject.box, 1), some_model());
  EXPECT_EQ(plan.efficiency, 1);
  EXPECT_EQ(plan.n_messages, 0);
  EXPECT_EQ(plan.message_bytes, 0);
  EXPECT_EQ(plan.halo_nodes, 0);
  EXPECT_EQ(plan.first_rank_bytes, 0);
}

// 44 layers in seven parts are 6 or 7.
TEST(RankPlan, WithoutWaitingAndMembranesIsAsEfficientAsPartsAreAlike) {
  auto subject = subject_of(parse(least_case));
  subject.membranes.clear();
  const auto plan = rank_plan(subject, ranks::least_surface(subject.box, 7), fluid_alone());
  EXPECT_EQ(plan.parts, (ranks::Triple{1, 1, 7}));
  EXPECT_EQ(plan.largest, (ranks::Triple{36, 40, 7}));
  EXPECT_EQ(plan.smallest, (ranks::Triple{36, 40, 6}));
  EXPECT_DOUBLE_EQ(plan.efficiency, 44.0 / 49);
  EXPECT_EQ(plan.message_seconds, 0);
}

TEST(RankPlan, GoesWithTheNetwork) {
  const auto subject = subject_of(parse(least_case));
  const auto division = ranks::least_surface(subject.box, 8);
  const auto efficiency = [&](double latency, double bandwidth) {
    auto model = some_model();
    model.latency_seconds = latency;
    model.bytes_per_second = bandwidth;
    return rank_plan(subject, division, model).efficiency;
  };
  EXPECT_GT(efficiency(1e-6, 1e9), efficiency(1e-4, 1e9));
  EXPECT_GT(efficiency(1e-6, 1e9), efficiency(1e-6, 1e8));
  const auto the_case = parse(least_case, {"run.message_latency_us=3", "run.message_bandwidth_GB_s=0.5"});
  Cost cost;
  cost.fluid_node_seconds = 7;
  cost.membrane_node_seconds = 8;
  const auto model = rank_model(the_case, cost);
  EXPECT_DOUBLE_EQ(model.latency_seconds, 3e-6);
  EXPECT_DOUBLE_EQ(model.bytes_per_second, 5e8);
  EXPECT_EQ(model.node_seconds, 7);
  EXPECT_EQ(model.membrane_node_seconds, 8);
}

TEST(RankPlan, OfMoreRanksTakesLessTimeAndMemoryButIsLessEfficient) {
  const auto subject = subject_of(parse(least_case, {"flow.box=[128, 128, 128]"}));
  auto model = some_model();
  model.latency_seconds = 1e-6;
  model.bytes_per_second = 1e9;
  auto before = rank_plan(subject, ranks::least_surface(subject.box, 1), model);
  for (int n_ranks = 2; n_ranks <= 4096; n_ranks *= 2) {
    const auto plan = rank_plan(subject, ranks::least_surface(subject.box, n_ranks), model);
    EXPECT_LT(plan.step_seconds(), before.step_seconds()) << n_ranks;
    EXPECT_LT(plan.fluid_memory_bytes, before.fluid_memory_bytes) << n_ranks;
    EXPECT_LT(plan.efficiency, before.efficiency) << n_ranks;
    before = plan;
  }
}

// Capsules of 2562 and 642 nodes: two ranks have one each, and the larger counts. The first one gathers
// files: a state of the box, but for one in pieces, of which each rank has layers and what crosses its cuts;
// and membranes, as many triangles as a file may have.
TEST(RankPlan, SharesCapsules) {
  const auto subject = subject_of(parse(full_case));
  ASSERT_EQ(subject.membranes.size(), 2u);
  const auto division = ranks::least_surface(subject.box, 2);
  const auto plan = rank_plan(subject, division, some_model());
  EXPECT_EQ(plan.membrane_seconds, 2562 * 0x1p-14);
  EXPECT_EQ(plan.membrane_memory_bytes, subject.membranes[0].bytes);
  EXPECT_EQ(plan.first_rank_bytes, 40 * 50 * 60 * 176.0 + 2 * 370.0 * (5120 + 1280));
  auto cut = parse(full_case);
  cut.output.whole_file_nodes = 1;
  const auto in_pieces = rank_plan(subject_of(cut), division, some_model());
  EXPECT_EQ(in_pieces.first_rank_bytes, 2 * 370.0 * (5120 + 1280));
  cut.output.whole_file_triangles = 1300;
  const auto all_in_pieces =
      rank_plan(subject_of(cut), division, some_model());  // of which each rank has one
  EXPECT_EQ(all_in_pieces.first_rank_bytes, 0);
  EXPECT_EQ(all_in_pieces.membrane_memory_bytes, subject.membranes[0].bytes + 2 * 370.0 * 1300);
  const auto halo = static_cast<double>(in_pieces.halo_nodes);
  EXPECT_EQ(in_pieces.fluid_memory_bytes - plan.fluid_memory_bytes,
            16e6 + 3 * 152 * halo - 20 * 50 * 60 * 176.0);
  EXPECT_EQ(capsules_of_a_rank(1000, 999), 2);
  EXPECT_EQ(capsules_of_a_rank(1000, 100'000), 1);
  EXPECT_EQ(capsules_of_a_rank(0, 8), 0);
}

TEST(RankPlan, WithoutASpeedSaysNoTime) {
  const auto subject = subject_of(parse(least_case));
  const auto plan = rank_plan(subject, ranks::least_surface(subject.box, 8), RankModel());
  EXPECT_EQ(plan.step_seconds(), 0);
  EXPECT_EQ(plan.efficiency, 0);
  EXPECT_GT(plan.message_bytes, 0);
}

TEST(RankPlan, IsMadeOfManyRanks) {
  const auto subject = subject_of(parse(least_case, {"flow.box=[400, 400, 400]"}));
  const auto plan = rank_plan(subject, ranks::least_surface(subject.box, 100'000), some_model());
  EXPECT_EQ(plan.n_ranks(), 100'000);
  EXPECT_EQ(nodes_in(plan.largest), 640);
  EXPECT_THAT(rank_steps(1), ElementsAre(1));
  EXPECT_THAT(rank_steps(6), ElementsAre(1, 2, 4, 6));
  EXPECT_THAT(rank_steps(8), ElementsAre(1, 2, 4, 8));
  EXPECT_EQ(rank_steps(100'000).size(), 18u);
  EXPECT_LE(rank_steps(10'000'000).size(), 18u);
  EXPECT_EQ(rank_steps(10'000'000)[1], 4);
}

std::string refusal_of(const Case& the_case, int n_ranks) {
  try {
    planned_division(the_case, n_ranks);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(RankPlan, IsCutAsTheRunWouldBe) {
  const auto given = parse(least_case, {"run.ranks=[2, 2, 2]"});
  EXPECT_EQ(planned_division(given, 8).parts(), (ranks::Triple{2, 2, 2}));
  EXPECT_EQ(planned_division(given, 4).parts(), (ranks::Triple{1, 1, 4}));
  EXPECT_THAT(refusal_of(parse(least_case), 47),
              AllOf(HasSubstr("case.toml: --ranks 47"), HasSubstr("36 x 40 x 44"), HasSubstr("46 would do")));
  EXPECT_THAT(refusal_of(parse(least_case, {"run.ranks=[0, 1, 2]"}), 2), HasSubstr("1 at least"));
  EXPECT_THAT(refusal_of(parse(least_case, {"run.ranks=[13, 1, 1]"}), 13), HasSubstr("1 to 12"));
  EXPECT_THAT(refusal_of(parse(least_case, {"flow.command=[\"sh\"]"}), 2), HasSubstr("flow.command"));
}

TEST(RankPlan, WarnsOfWhatDoesNotPay) {
  const auto the_case = parse(least_case, {"run.ranks=[1, 1, 2]"});
  RankPlan plan;
  plan.parts = {1, 1, 2};
  plan.largest = {10, 10, 10};
  plan.halo_nodes = 500;
  plan.fluid_seconds = 1;
  plan.efficiency = 0.5;
  EXPECT_THAT(rank_warnings(the_case, plan), IsEmpty());
  plan.halo_nodes = 501;
  EXPECT_THAT(rank_warnings(the_case, plan), ElementsAre(HasSubstr("the halo")));
  plan.halo_nodes = 0;
  plan.efficiency = 0.49;
  EXPECT_THAT(rank_warnings(the_case, plan), ElementsAre(HasSubstr("the efficiency is 49 %")));
  plan.efficiency = 0;  // not known
  plan.parts = {1, 1, 4};
  EXPECT_THAT(rank_warnings(the_case, plan), ElementsAre(HasSubstr("run.ranks = [1, 1, 2] is for 2 ranks")));
}

// The capsule of more nodes, in the middle of a smaller box.
TEST(RankPlan, TriesASampleOfALargeBox) {
  const auto the_case = parse(full_case, {"flow.box=[400, 50, 400]"});
  const auto sizes = sizes_of(membrane_shapes(the_case).meshes);
  const auto sample = sample_of(the_case, sizes, made_shapes(the_case));
  EXPECT_EQ(sample.flow.box, (std::array<int, 3>{96, 50, 96}));
  ASSERT_EQ(sample.capsules.size(), 1u);
  EXPECT_EQ(sample.capsules[0].radius, 5.1);
  EXPECT_EQ(sample.capsules[0].position, (std::array<double, 3>{48, 25, 48}));
  const auto probe = try_sample(the_case, parameters(the_case), sizes, made_shapes(the_case));
  EXPECT_EQ(probe.breakdown, "");
  EXPECT_GT(probe.fluid_node_seconds, 0);
  EXPECT_GT(probe.membrane_node_seconds, 0);
  const double nodes = 400.0 * 50 * 400, membrane_nodes = 2562 + 642;
  EXPECT_DOUBLE_EQ(
      probe.mlups,
      1e-6 * nodes / (nodes * probe.fluid_node_seconds + membrane_nodes * probe.membrane_node_seconds));
}

// A case that memory holds nowhere is planned all the same, but not as one that is run here.
TEST(RankPlan, IsMadeWhereMemoryDoesNotHoldTheBox) {
  const auto the_case = parse(droplet_case, {"flow.box=[20000, 20000, 20000]"});
  EXPECT_THROW(make_plan(the_case), InputError);
  const auto plan = make_plan(the_case, {}, 0, Trial::sample);
  EXPECT_GT(plan.cost.mlups, 0);
  EXPECT_THAT(plan.echo, HasSubstr("from a sample"));
  const auto report = rank_report(plan, planned_division(the_case, 64000));
  EXPECT_THAT(report,
              AllOf(HasSubstr("on 64000 ranks"), HasSubstr("500 x 500 x 500"), HasSubstr("125000000")));
}

}  // namespace
}  // namespace tanktread::driver::rank_plan_test
