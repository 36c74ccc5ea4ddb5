#include "driver/plan/rank_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>
#include <numeric>
#include <set>
#include <stdexcept>
#include <tuple>

#include "driver/case/case_geometry.hpp"
#include "driver/program/errors.hpp"
#include "driver/system/components.hpp"
#include "driver/system/fluid_output.hpp"
#include "driver/system/halo_by_ranks.hpp"
#include "driver/system/run_ranks.hpp"
#include "fluid/part_sizes.hpp"

namespace tanktread::driver {
namespace {

/// Parts along an axis, one of each length and place (at the low end, at the high end, between).
std::vector<int> kinds_along(const ranks::Division& division, int axis) {
  std::vector<int> found;
  std::set<std::tuple<int, bool, bool>> known;
  const int n_parts = division.parts()[axis];
  ranks::Triple place = {0, 0, 0};
  for (int k = 0; k < n_parts; ++k) {
    place[axis] = k;
    const int rank = (place[2] * division.parts()[1] + place[1]) * division.parts()[0] + place[0];
    if (known.insert({division.block(rank).n[axis], k == 0, k == n_parts - 1}).second) found.push_back(k);
  }
  return found;
}

/// The first ceil(M/N) membranes.
RankSubject::Membrane largest_share(const RankSubject& subject, int n_ranks) {
  const auto n_own = capsules_of_a_rank(static_cast<std::int64_t>(subject.membranes.size()), n_ranks);
  RankSubject::Membrane sum;
  for (std::int64_t k = 0; k < n_own; ++k) {
    sum.nodes += subject.membranes[k].nodes;
    sum.bytes += subject.membranes[k].bytes;
  }
  return sum;
}

/// Other ranks that a part sends to.
int neighbours_of(const ranks::Division& division, int rank, const fluid::PartSizes& sizes) {
  std::set<int> others;
  for (const auto& message : sizes.messages) {
    if (const auto other = division.neighbour(rank, message.direction)) others.insert(*other);
  }
  others.erase(rank);
  return static_cast<int>(others.size());
}

/// Takes a part into account.
void add_part(RankPlan& plan, const RankSubject& subject, const ranks::Division& division, int rank,
              const RankModel& model) {
  const auto n = division.block(rank).n;
  const auto sizes = fluid::part_sizes(subject.fluid, part_of(division, rank));
  const auto bytes = sizes.message_bytes();
  const auto n_messages = static_cast<int>(sizes.messages.size());
  if (nodes_in(n) > nodes_in(plan.largest)) {
    plan.largest = n;
    plan.halo_nodes = 0;
  }
  if (n == plan.largest) plan.halo_nodes = std::max(plan.halo_nodes, sizes.halo_nodes);
  if (plan.smallest[0] == 0 || nodes_in(n) < nodes_in(plan.smallest)) plan.smallest = n;
  plan.n_messages = std::max(plan.n_messages, n_messages);
  plan.n_neighbours = std::max(plan.n_neighbours, neighbours_of(division, rank, sizes));
  plan.message_bytes = std::max(plan.message_bytes, bytes);
  for (const auto& message : sizes.messages)
    plan.largest_message_bytes = std::max(plan.largest_message_bytes, message.bytes);
  // What goes out and what comes in.
  const double memory = static_cast<double>(sizes.population_bytes + 2 * bytes) +
                        subject.node_bytes * static_cast<double>(sizes.nodes) +
                        subject.halo_node_bytes * static_cast<double>(sizes.halo_nodes) + subject.part_bytes;
  plan.fluid_memory_bytes = std::max(plan.fluid_memory_bytes, memory);
  const double fluid = model.node_seconds * static_cast<double>(sizes.nodes);
  const double messages =
      n_messages * model.latency_seconds + static_cast<double>(bytes) / model.bytes_per_second;
  if (fluid + messages <= plan.fluid_seconds + plan.message_seconds) return;
  plan.fluid_seconds = fluid;
  plan.message_seconds = messages;
}

double membrane_seconds(const RankSubject& subject, int n_ranks, const RankModel& model) {
  return model.membrane_node_seconds * largest_share(subject, n_ranks).nodes;
}

/// Of the whole box on one rank, which sends nothing.
double one_rank_seconds(const RankSubject& subject, const RankModel& model) {
  return model.node_seconds * static_cast<double>(nodes_in(subject.box.n)) +
         membrane_seconds(subject, 1, model);
}

/// Without a speed no second is said, not even of messages.
void forget_seconds(RankPlan& plan) {
  plan.fluid_seconds = plan.message_seconds = plan.membrane_seconds = plan.efficiency = 0;
}

std::string list_text(const ranks::Triple& n) {
  return fmt::format("[{}, {}, {}]", n[0], n[1], n[2]);
}

}  // namespace

RankModel rank_model(const Case& the_case, const Cost& cost) {
  RankModel model;
  model.node_seconds = cost.fluid_node_seconds;
  model.membrane_node_seconds = cost.membrane_node_seconds;
  model.latency_seconds = 1e-6 * the_case.run.message_latency_us;
  model.bytes_per_second = 1e9 * the_case.run.message_bandwidth_GB_s;
  return model;
}

RankSubject rank_subject(const Case& the_case, const FlowParameters& parameters,
                         std::span<const MeshSize> meshes) {
  RankSubject subject;
  subject.box = box_of_ranks(the_case);
  subject.fluid = fluid_settings(the_case, parameters);
  subject.node_bytes = fluid::lattice_boltzmann_force_memory_per_node;
  if (has_large_box(the_case)) {
    // Pieces are written and read by layers; the nodes at cuts go to and from the neighbours.
    subject.part_bytes = 16e6;
    subject.halo_node_bytes = 3 * fluid::lattice_boltzmann_populations_per_node;
  } else {
    subject.node_bytes += fluid::lattice_boltzmann_state_per_node;
    subject.gathered_bytes = fluid::lattice_boltzmann_state_per_node;
  }
  if (has_contrast(the_case)) {
    subject.node_bytes += 8 + 4;  // a viscosity, a mark
    if (!has_large_box(the_case)) {
      subject.node_bytes += 8;  // the viscosity in a state
      subject.gathered_bytes += 8 + 4;
    }
  }
  double n_triangles = 0;
  for (std::size_t k = 0; k < meshes.size(); ++k) {
    const auto nodes = static_cast<double>(meshes[k].n_nodes);
    subject.membranes.push_back({nodes, membrane_memory_bytes(the_case, k, nodes)});
    n_triangles += static_cast<double>(meshes[k].n_triangles);
  }
  subject.has_pieces_of_membranes = n_triangles > the_case.output.whole_file_triangles;
  // With what it is put together from.
  subject.surface_bytes =
      2 * triangle_state_bytes * std::min<double>(n_triangles, the_case.output.whole_file_triangles);
  std::ranges::stable_sort(subject.membranes, std::greater(), &RankSubject::Membrane::nodes);
  return subject;
}

std::vector<int> kinds_of_parts(const ranks::Division& division) {
  std::vector<int> found;
  const auto along_x = kinds_along(division, 0), along_y = kinds_along(division, 1),
             along_z = kinds_along(division, 2);
  for (const int z : along_z)
    for (const int y : along_y)
      for (const int x : along_x) found.push_back((z * division.parts()[1] + y) * division.parts()[0] + x);
  return found;
}

RankPlan rank_plan(const RankSubject& subject, const ranks::Division& division, const RankModel& model) {
  const int n_ranks = division.n_ranks();
  RankPlan plan;
  plan.parts = division.parts();
  for (const int rank : kinds_of_parts(division)) add_part(plan, subject, division, rank, model);
  plan.membrane_memory_bytes = largest_share(subject, n_ranks).bytes;
  if (n_ranks > 1) {
    plan.first_rank_bytes = subject.gathered_bytes * static_cast<double>(nodes_in(subject.box.n));
    (subject.has_pieces_of_membranes ? plan.membrane_memory_bytes : plan.first_rank_bytes) +=
        subject.surface_bytes;
  }
  plan.membrane_seconds = membrane_seconds(subject, n_ranks, model);
  plan.efficiency = one_rank_seconds(subject, model) / (n_ranks * plan.step_seconds());
  if (model.node_seconds == 0) forget_seconds(plan);
  return plan;
}

std::vector<int> rank_steps(int n_ranks) {
  constexpr std::size_t most = 18;
  std::vector<int> steps;
  for (std::int64_t factor = 2; steps.empty() || steps.size() > most; factor *= 2) {
    steps.clear();
    for (std::int64_t n = 1; n < n_ranks; n *= factor) steps.push_back(static_cast<int>(n));
    steps.push_back(n_ranks);
  }
  return steps;
}

ranks::Division planned_division(const Case& the_case, int n_ranks) {
  if (n_ranks > 1 && !the_case.flow.command.empty()) {
    throw InputError(
        fmt::format("{}: --ranks {}: flow.command: a program in the place of the fluid has one rank; give "
                    "--ranks 1, or remove the key",
                    the_case.file.string(), n_ranks));
  }
  const auto& given = the_case.run.ranks;
  const bool is_given = given != RunCase().ranks;
  const auto n_given = nodes_in(given);
  if (is_given && (n_given == 0 || n_given == n_ranks)) return division_of(the_case, n_ranks);
  try {
    return ranks::least_surface(box_of_ranks(the_case), n_ranks);
  } catch (const std::invalid_argument& error) {
    throw InputError(fmt::format("{}: --ranks {}: {}", the_case.file.string(), n_ranks, error.what()));
  }
}

std::vector<std::string> rank_warnings(const Case& the_case, const RankPlan& plan) {
  constexpr double most_halo = 0.5, least_efficiency = 0.5;
  std::vector<std::string> lines;
  const auto& given = the_case.run.ranks;
  if (given != RunCase().ranks && nodes_in(given) != plan.n_ranks()) {
    lines.push_back(
        fmt::format("run.ranks = {} is for {} ranks, and has no effect here; a run on {} refuses it",
                    list_text(given), nodes_in(given), plan.n_ranks()));
  }
  const auto nodes = static_cast<double>(nodes_in(plan.largest));
  if (static_cast<double>(plan.halo_nodes) > most_halo * nodes) {
    lines.push_back(fmt::format(
        "the halo of a part has {:.0f} % of the nodes of the part, over {:.0f} %: parts are small; "
        "take fewer ranks, with more threads each",
        100 * static_cast<double>(plan.halo_nodes) / nodes, 100 * most_halo));
  }
  if (plan.efficiency > 0 && plan.efficiency < least_efficiency) {
    const auto share = [&](double seconds) { return 100 * seconds / plan.step_seconds(); };
    lines.push_back(fmt::format(
        "the efficiency is {:.2g} %, below {:.0f} %: of a step the fluid takes {:.0f} %, messages "
        "{:.0f} %, the membranes of one rank {:.0f} %; take fewer ranks",
        100 * plan.efficiency, 100 * least_efficiency, share(plan.fluid_seconds), share(plan.message_seconds),
        share(plan.membrane_seconds)));
  }
  return lines;
}

}  // namespace tanktread::driver
