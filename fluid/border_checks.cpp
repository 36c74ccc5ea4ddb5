#include "fluid/border_checks.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "fluid/d3q19.hpp"

namespace tanktread::fluid {
namespace {

/// Components of an array that a solver knows; 0: it does not know it.
int components_of(const std::string& array) {
  if (array == "populations") return d3q19::n_directions;
  return array == "force" ? 3 : (array == "viscosity" ? 1 : 0);
}

bool has_array(const StateShape& state, const char* name) {
  return std::ranges::any_of(state.arrays, [&](const auto& array) { return array.name == name; });
}

std::span<const double> checked(const StateArray& array, std::int64_t n_nodes) {
  const std::int64_t needed = array.components * n_nodes;
  if (std::ssize(array.values) != needed) {
    refuse("state array '" + array.name + "' has " + std::to_string(array.values.size()) + " values; " +
           std::to_string(needed) + " are needed for this box");
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

std::int64_t check_layers(const std::string& what, Layers layers, const GridShape& shape) {
  if (0 <= layers.begin && layers.begin <= layers.end && layers.end <= shape.nz)
    return std::int64_t{layers.end - layers.begin} * shape.nx * shape.ny;
  refuse(what + " got layers " + std::to_string(layers.begin) + " to before " + std::to_string(layers.end) +
         ", the box has " + std::to_string(shape.nz));
}

void check_nodes(const std::string& what, std::span<const std::int64_t> nodes, std::size_t n_numbers,
                 std::int64_t n_nodes, int threads) {
  if (n_numbers != 3 * nodes.size()) {
    refuse(what + " got " + std::to_string(n_numbers) + " numbers for " + std::to_string(nodes.size()) +
           " nodes, 3 a node are needed");
  }
  check_in_box(what, nodes, n_nodes, threads);
}

void check_viscosity_from(std::int64_t first_node, std::span<const double> kinematic_viscosity) {
  for (std::size_t k = 0; k < kinematic_viscosity.size(); ++k)
    check_viscosity_of(first_node + static_cast<std::int64_t>(k), kinematic_viscosity[k]);
}

void check_viscosity(std::span<const double> kinematic_viscosity, std::int64_t n_nodes) {
  check_count(kinematic_viscosity, n_nodes);
  check_viscosity_from(0, kinematic_viscosity);
}

void check_viscosity_of_nodes(std::span<const std::int64_t> nodes,
                              std::span<const double> kinematic_viscosity, std::int64_t n_nodes) {
  check_count(kinematic_viscosity, static_cast<std::int64_t>(nodes.size()));
  check_in_box("set_viscosity()", nodes, n_nodes, 1);  // in most steps a handful: not worth waking threads
  for (std::size_t k = 0; k < nodes.size(); ++k) check_viscosity_of(nodes[k], kinematic_viscosity[k]);
}

StateArrays check_state(const State& state, std::int64_t n_nodes) {
  check_state_shape(shape_of(state));
  StateArrays arrays;
  for (const auto& array : state.arrays) {
    const auto values = checked(array, n_nodes);
    if (array.name == "populations") arrays.populations = values;
    if (array.name == "force") arrays.force = values;
    if (array.name == "viscosity") arrays.viscosity = values;
  }
  check_viscosity_from(0, arrays.viscosity);
  return arrays;
}

void check_state_shape(const StateShape& state) {
  if (state.step < 0) refuse("the state's step is " + std::to_string(state.step) + ", must be >= 0");
  for (const auto& array : state.arrays) {
    const int needed = components_of(array.name);
    if (needed == 0) {
      refuse("the state has an array '" + array.name +
             "', which this solver does not know (it knows populations, force, viscosity)");
    }
    if (array.components != needed) {
      refuse("state array '" + array.name + "' has " + std::to_string(array.components) + " components; " +
             std::to_string(needed) + " are needed");
    }
  }
  for (const char* name : {"populations", "force"})
    if (!has_array(state, name)) refuse(std::string("the state has no array '") + name + "'");
}

}  // namespace tanktread::fluid
