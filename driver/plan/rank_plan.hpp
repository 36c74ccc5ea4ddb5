// What a run on many ranks would be, from a model: parts, memory, messages, time of a step.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "driver/case/case.hpp"
#include "driver/plan/cost.hpp"
#include "driver/units/units.hpp"
#include "fluid/lattice_boltzmann.hpp"
#include "ranks/division.hpp"

namespace tanktread::driver {

/// Nodes of a block, by those along x, y, z.
inline std::int64_t nodes_in(const ranks::Triple& n) {
  return std::int64_t{n[0]} * n[1] * n[2];
}

/// What the model takes as given. Seconds of a step on N ranks:
///
///   t(N) = max over parts of (n s + m l + b/B) + q c,   efficiency = t(1)/(N t(N))
///
/// n nodes of the part, m messages and b bytes that it sends (as many come at the same time); q membrane
/// nodes of the rank that has the most, which is taken to have the ceil(M/N) largest of the M capsules.
/// Left out: what is computed while messages travel; cores that share a memory or a network.
struct RankModel {
  double node_seconds = 0;           ///< s, of the fluid's step; 0: not measured
  double membrane_node_seconds = 0;  ///< c, of the rest of a step, a membrane node
  double latency_seconds = 0;        ///< l, a message
  double bytes_per_second = std::numeric_limits<double>::infinity();  ///< B, each way
};

/// Of a case: run.message_latency_us, run.message_bandwidth_GB_s, and what was measured.
RankModel rank_model(const Case& the_case, const Cost& cost);

/// What of a case counts for its ranks.
struct RankSubject {
  ranks::Box box;
  fluid::LatticeBoltzmannSettings fluid;
  double node_bytes =
      0;  ///< of memory a node, beside populations: force, viscosity, a state if files are whole
  double halo_node_bytes = 0;  ///< likewise a node of the halo, while pieces are written
  double part_bytes = 0;       ///< likewise of a part: the layers of it that go to a piece
  double gathered_bytes =
      0;                     ///< a node of the box, on the first rank: a state, and marks, if files are whole
  double surface_bytes = 0;  ///< of the largest file of membranes, while it is put together
  bool has_pieces_of_membranes = false;  ///< so that every rank writes such a file, else the first one
  struct Membrane {
    double nodes = 0, bytes = 0;  ///< bytes of memory
  };
  std::vector<Membrane> membranes;  ///< those with the most nodes first
};
RankSubject rank_subject(const Case& the_case, const FlowParameters& parameters,
                         std::span<const MeshSize> meshes);

/// What the ranks of a division would have. Bytes are of memory, or of messages one way, a step.
struct RankPlan {
  ranks::Triple parts = {1, 1, 1};
  ranks::Triple largest = {0, 0, 0}, smallest = {0, 0, 0};  ///< nodes along x, y, z of these parts
  std::int64_t halo_nodes = 0;                              ///< of the largest part
  int n_neighbours = 0;                                     ///< other ranks, of the part with most
  int n_messages = 0;                                       ///< to them, of the part with most
  std::int64_t largest_message_bytes = 0;                   ///< of all
  std::int64_t message_bytes = 0;                           ///< of the part that sends most, all together
  double fluid_memory_bytes = 0;     ///< of a part: populations, halo, messages, force, state; of the largest
  double membrane_memory_bytes = 0;  ///< of the rank with most membrane nodes
  double first_rank_bytes = 0;       ///< more on the first rank: what it gathers for files
  double fluid_seconds = 0, message_seconds = 0;  ///< of a step, of the slowest part
  double membrane_seconds = 0;                    ///< likewise of the rank with most membrane nodes
  double efficiency = 0;                          ///< 0: not known, as all seconds

  int n_ranks() const { return parts[0] * parts[1] * parts[2]; }
  double step_seconds() const { return fluid_seconds + message_seconds + membrane_seconds; }
  double memory_bytes() const { return program_memory_bytes + fluid_memory_bytes + membrane_memory_bytes; }
};
RankPlan rank_plan(const RankSubject& subject, const ranks::Division& division, const RankModel& model);

/// ceil(M/N): of the rank that has the most of M capsules shared evenly.
inline std::int64_t capsules_of_a_rank(std::int64_t n_capsules, int n_ranks) {
  return (n_capsules + n_ranks - 1) / n_ranks;
}

/// Ranks among which every part that there is of its kind has one: parts differ by their lengths and by the
/// walls that they touch, so that no other part has other messages. At most 64.
std::vector<int> kinds_of_parts(const ranks::Division& division);

/// Numbers of ranks 1, 2, 4 ... and `n_ranks`, at most 18 of them (of more every second, fourth ...).
std::vector<int> rank_steps(int n_ranks);

/// How `n_ranks` ranks would share the box: as run.ranks says if it is for as many, else with the least
/// surface. @throws InputError naming file, --ranks, and what would do
ranks::Division planned_division(const Case& the_case, int n_ranks);

/// What a user should know of a plan, a sentence each: halo, efficiency, run.ranks for another number.
std::vector<std::string> rank_warnings(const Case& the_case, const RankPlan& plan);

}  // namespace tanktread::driver
