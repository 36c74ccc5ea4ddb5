// The state of a flow solver: what it needs to go on bit for bit, as a whole or in parts.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace tanktread::fluid {

/// A named array of a solver's state. `values` holds `components` numbers a node, component fastest, then x,
/// y, z.
struct StateArray {
  std::string name;
  int components = 1;
  std::vector<double> values;
};

/// Everything a solver needs to go on bit for bit: restore(state()) changes nothing that can be observed.
struct State {
  std::int64_t step = 0;           ///< number of steps done since the start
  std::vector<StateArray> arrays;  ///< the solver's own arrays, the last grid force among them
};

/// An array of a state without its numbers.
struct StateArrayShape {
  std::string name;
  int components = 1;
  bool operator==(const StateArrayShape&) const = default;
};

/// A state without its numbers.
struct StateShape {
  std::int64_t step = 0;
  std::vector<StateArrayShape> arrays;
  bool operator==(const StateShape&) const = default;
};

inline StateShape shape_of(const State& state) {
  StateShape shape{state.step, {}};
  for (const auto& array : state.arrays) shape.arrays.push_back({array.name, array.components});
  return shape;
}

/// The nodes of a box with z = begin, ..., end - 1. Numbers of layers are those of their nodes only, in the
/// order of those of all nodes.
struct Layers {
  int begin = 0, end = 0;
};

/// A state that a solver takes over in parts (Fluid::restore_from), so that nobody needs all of it at once.
class StateSource {
 public:
  virtual ~StateSource() = default;

  virtual StateShape shape() const = 0;

  /// The numbers of an array on some layers. A solver may ask more than once, in any order.
  /// @param array one of shape() @param values as many as there are; overwritten
  virtual void read(const std::string& array, Layers layers, std::span<double> values) const = 0;

  /// The solver has found that the state fits, and changes from now on. Here the source can still refuse:
  /// what it throws leaves the solver as it was.
  virtual void accepted() const {}
};

}  // namespace tanktread::fluid
