// Checks of what comes in over the border, shared by the fast and the plain solver. Internal to fluid/.
// Each check throws std::invalid_argument with the name, what came and what is needed.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "fluid/fluid.hpp"

namespace tanktread::fluid {

/// Throws std::invalid_argument with `what` after the name of the component.
[[noreturn]] void refuse(const std::string& what);

/// `what` has this many numbers.
void check_size(const std::string& what, std::size_t size, std::int64_t needed);

/// The layers are in the box. @return how many nodes they have
std::int64_t check_layers(const std::string& what, Layers layers, const GridShape& shape);

/// 3 numbers for each of the nodes, and every node in the box.
void check_nodes(const std::string& what, std::span<const std::int64_t> nodes, std::size_t n_numbers,
                 std::int64_t n_nodes, int threads = 1);

/// One viscosity a node, each positive and finite.
/// @param first_node that the first one is of, for the message
void check_viscosity_from(std::int64_t first_node, std::span<const double> kinematic_viscosity);
void check_viscosity(std::span<const double> kinematic_viscosity, std::int64_t n_nodes);

/// One viscosity for each of the nodes, positive and finite, and every node in the box.
void check_viscosity_of_nodes(std::span<const std::int64_t> nodes,
                              std::span<const double> kinematic_viscosity, std::int64_t n_nodes);

/// The arrays of a state.
struct StateArrays {
  std::span<const double> populations, force;
  std::span<const double> viscosity;  ///< empty if the state has none: the settings' own everywhere
};

/// The arrays "populations", "force" and, if there, "viscosity", each of the right size; nothing else, and
/// the step not negative.
StateArrays check_state(const State& state, std::int64_t n_nodes);

/// The same of a state without its numbers.
void check_state_shape(const StateShape& state);

}  // namespace tanktread::fluid
