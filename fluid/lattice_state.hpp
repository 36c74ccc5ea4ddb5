// What a state holds, taken from the lattice and put back, all of it or some layers. Internal to fluid/.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "fluid/border_checks.hpp"
#include "fluid/force_field.hpp"
#include "fluid/layer_ranges.hpp"
#include "fluid/node_rates.hpp"
#include "fluid/population_lattice.hpp"

namespace tanktread::fluid {

/// As doubles, which hold the lattice's numbers exactly: 19 a node. As PopulationLattice.
template <typename Real>
void get_outgoing(const PopulationLattice<Real>& lattice, Turn last, int x, int y, int z,
                  double* populations) {
  Real numbers[d3q19::n_directions];
  lattice.get_outgoing(last, x, y, z, numbers);
  std::copy_n(numbers, d3q19::n_directions, populations);
}
template <typename Real>
void put_outgoing(PopulationLattice<Real>& lattice, Turn last, int x, int y, int z,
                  const double* populations) {
  Real numbers[d3q19::n_directions];
  std::transform(populations, populations + d3q19::n_directions, numbers,
                 [](double number) { return static_cast<Real>(number); });
  lattice.put_outgoing(last, x, y, z, numbers);
}

/// A whole state as a source of parts. Borrowed.
class StateInMemory final : public StateSource {
 public:
  /// @param state of a size that was checked
  StateInMemory(const State& state, const GridShape& shape)
      : state_(state), nodes_a_layer_(std::int64_t{shape.nx} * shape.ny) {}

  StateShape shape() const override { return shape_of(state_); }
  void read(const std::string& name, Layers layers, std::span<double> values) const override {
    const auto array = std::ranges::find(state_.arrays, name, &StateArray::name);
    std::copy_n(array->values.begin() + array->components * nodes_a_layer_ * layers.begin, values.size(),
                values.begin());
  }

 private:
  const State& state_;
  std::int64_t nodes_a_layer_;
};

/// The arrays of a state in the memory of a solver, which is borrowed. @tparam Real of the lattice
template <typename Real>
class LatticeState {
 public:
  LatticeState(PopulationLattice<Real>& lattice, NodeRates<Real>& rates, ForceField& force, int n_threads)
      : lattice_(lattice), rates_(rates), force_(force), n_threads_(n_threads) {}

  /// The viscosity is there once one was set.
  std::vector<StateArrayShape> arrays() const {
    std::vector<StateArrayShape> arrays = {{"populations", d3q19::n_directions}, {"force", 3}};
    if (rates_.is_set()) arrays.push_back({"viscosity", 1});
    return arrays;
  }

  /// @param last the kind of the step that was done last @throws as Fluid::state_of_layers
  void get(const std::string& array, Layers layers, Turn last, std::span<double> values) const {
    const auto n = check_layers("state_of_layers()", layers, shape());
    const auto all = arrays();
    const auto found = std::ranges::find(all, array, &StateArrayShape::name);
    if (found == all.end()) refuse("the state has no array '" + array + "'");
    check_size("state_of_layers(): '" + array + "'", values.size(), found->components * n);
    const auto first = first_node(layers);
    if (array == "viscosity") return rates_.viscosity(first, values);
    if (array == "force") {
      std::ranges::copy(force_.added().subspan(3 * first, values.size()), values.begin());
      return;
    }
    for_each_node(layers, [&](int x, int y, int z, std::int64_t node) {
      get_outgoing(lattice_, last, x, y, z, &values[d3q19::n_directions * (node - first)]);
    });
  }

  /// Nothing is changed. @throws std::invalid_argument as Fluid::restore
  void check(const StateSource& source, const StateShape& its_shape) const {
    check_state_shape(its_shape);
    for_parts(source, its_shape, "viscosity", [&](Layers layers, std::span<const double> values) {
      check_viscosity_from(first_node(layers), values);
    });
  }

  /// Of a state that was checked. @param last the kind of the step that its populations come from
  void put(const StateSource& source, const StateShape& its_shape, Turn last) {
    for_parts(source, its_shape, "viscosity", [&](Layers layers, std::span<const double> values) {
      rates_.set_rows(first_row(layers), values);
    });
    for_parts(source, its_shape, "force", [&](Layers layers, std::span<const double> values) {
      force_.restore(first_row(layers), values);
    });
    for_parts(source, its_shape, "populations", [&](Layers layers, std::span<const double> values) {
      for_each_node(layers, [&](int x, int y, int z, std::int64_t node) {
        put_outgoing(lattice_, last, x, y, z, &values[d3q19::n_directions * (node - first_node(layers))]);
      });
    });
  }

  static bool has_viscosity(const StateShape& state) {
    return std::ranges::find(state.arrays, "viscosity", &StateArrayShape::name) != state.arrays.end();
  }

 private:
  const GridShape& shape() const { return lattice_.shape(); }
  std::int64_t first_row(Layers layers) const { return std::int64_t{layers.begin} * shape().ny; }
  std::int64_t first_node(Layers layers) const { return first_row(layers) * shape().nx; }

  /// Calls with each range of layers of an array, and its numbers; not at all if the state has none.
  template <typename Body>
  void for_parts(const StateSource& source, const StateShape& its_shape, const std::string& name,
                 const Body& body) const {
    const auto array = std::ranges::find(its_shape.arrays, name, &StateArrayShape::name);
    if (array == its_shape.arrays.end()) return;
    const std::int64_t numbers_a_layer = std::int64_t{array->components} * shape().nx * shape().ny;
    std::vector<double> values;
    for_layer_ranges(std::int64_t{shape().nx} * shape().ny, shape().nz, array->components,
                     [&](Layers layers) {
                       values.resize(static_cast<std::size_t>((layers.end - layers.begin) * numbers_a_layer));
                       source.read(name, layers, values);
                       body(layers, values);
                     });
  }

  template <typename Body>
  void for_each_node(Layers layers, const Body& body) const {
    const std::int64_t nx = shape().nx, ny = shape().ny;
#pragma omp parallel for num_threads(n_threads_) schedule(static)
    for (std::int64_t row = layers.begin * ny; row < layers.end * ny; ++row) {
      const auto y = static_cast<int>(row % ny), z = static_cast<int>(row / ny);
      for (std::int64_t x = 0; x < nx; ++x) body(static_cast<int>(x), y, z, row * nx + x);
    }
  }

  PopulationLattice<Real>& lattice_;
  NodeRates<Real>& rates_;
  ForceField& force_;
  int n_threads_;
};

}  // namespace tanktread::fluid
