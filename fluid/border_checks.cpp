#include "fluid/border_checks.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "fluid/d3q19.hpp"

namespace tanktread::fluid {
namespace {

std::span<const double> checked(const StateArray& array, int components, std::int64_t n_nodes) {
  if (array.components != components ||
      static_cast<std::int64_t>(array.values.size()) != components * n_nodes) {
    refuse("state array '" + array.name + "' has " + std::to_string(array.components) + " components and " +
           std::to_string(array.values.size()) + " values; " + std::to_string(components) + " and " +
           std::to_string(components * n_nodes) + " are needed for this box");
  }
  return array.values;
}

void check_in_box(const std::string& what, std::span<const std::int64_t> nodes, std::int64_t n_nodes,
                  int threads) {
  const auto n_listed = static_cast<std::int64_t>(nodes.size());
  std::int64_t first_bad = n_listed;
#pragma omp parallel for num_threads(threads) schedule(static) reduction(min : first_bad)
  for (std::int64_t k = 0; k < n_listed; ++k) {
    if (nodes[k] < 0 || nodes[k] >= n_nodes) first_bad = std::min(first_bad, k);
  }
  if (first_bad == n_listed) return;
  refuse(what + " got node " + std::to_string(nodes[first_bad]) + ", the box has nodes 0 to " +
         std::to_string(n_nodes - 1));
}

void check_count(std::span<const double> kinematic_viscosity, std::int64_t n_nodes) {
  if (static_cast<std::int64_t>(kinematic_viscosity.size()) == n_nodes) return;
  refuse("set_viscosity() got " + std::to_string(kinematic_viscosity.size()) + " values for " +
         std::to_string(n_nodes) + " nodes");
}

void check_viscosity_of(std::int64_t node, double kinematic_viscosity) {
  if (std::isfinite(kinematic_viscosity) && kinematic_viscosity > 0.0) return;
  std::ostringstream message;
  message << "kinematic viscosity of node " << node << " is " << kinematic_viscosity
          << ", must be > 0 and finite";
  refuse(message.str());
}

}  // namespace

void refuse(const std::string& what) {
  throw std::invalid_argument("lattice Boltzmann: " + what);
}

void check_size(const std::string& what, std::size_t size, std::int64_t needed) {
  if (static_cast<std::int64_t>(size) != needed) {
    refuse(what + " has room for " + std::to_string(size) + " numbers, " + std::to_string(needed) +
           " are needed");
  }
}

void check_nodes(const std::string& what, std::span<const std::int64_t> nodes, std::size_t n_numbers,
                 std::int64_t n_nodes, int threads) {
  if (n_numbers != 3 * nodes.size()) {
    refuse(what + " got " + std::to_string(n_numbers) + " numbers for " + std::to_string(nodes.size()) +
           " nodes, 3 a node are needed");
  }
  check_in_box(what, nodes, n_nodes, threads);
}

void check_viscosity(std::span<const double> kinematic_viscosity, std::int64_t n_nodes) {
  check_count(kinematic_viscosity, n_nodes);
  for (std::int64_t node = 0; node < n_nodes; ++node) check_viscosity_of(node, kinematic_viscosity[node]);
}

void check_viscosity_of_nodes(std::span<const std::int64_t> nodes,
                              std::span<const double> kinematic_viscosity, std::int64_t n_nodes) {
  check_count(kinematic_viscosity, static_cast<std::int64_t>(nodes.size()));
  check_in_box("set_viscosity()", nodes, n_nodes, 1);  // in most steps a handful: not worth waking threads
  for (std::size_t k = 0; k < nodes.size(); ++k) check_viscosity_of(nodes[k], kinematic_viscosity[k]);
}

StateArrays check_state(const State& state, std::int64_t n_nodes) {
  if (state.step < 0) refuse("the state's step is " + std::to_string(state.step) + ", must be >= 0");
  StateArrays arrays;
  for (const auto& array : state.arrays) {
    if (array.name == "populations") {
      arrays.populations = checked(array, d3q19::n_directions, n_nodes);
    } else if (array.name == "force") {
      arrays.force = checked(array, 3, n_nodes);
    } else if (array.name == "viscosity") {
      arrays.viscosity = checked(array, 1, n_nodes);
      check_viscosity(arrays.viscosity, n_nodes);
    } else {
      refuse("the state has an array '" + array.name +
             "', which this solver does not know (it knows populations, force, viscosity)");
    }
  }
  if (arrays.populations.empty()) refuse("the state has no array 'populations'");
  if (arrays.force.empty()) refuse("the state has no array 'force'");
  return arrays;
}

}  // namespace tanktread::fluid
