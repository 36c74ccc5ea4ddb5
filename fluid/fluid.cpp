// What a solver without a way of its own does when it is asked for parts: all, of which it gives a part.
#include "fluid/fluid.hpp"

#include <algorithm>
#include <vector>

namespace tanktread::fluid {
namespace {

void require(bool fits, const std::string& what) {
  if (!fits) throw std::invalid_argument("fluid: " + what);
}

/// Nodes of the layers.
std::size_t nodes_of(Layers layers, const GridShape& shape) {
  require(0 <= layers.begin && layers.begin <= layers.end && layers.end <= shape.nz,
          "layers " + std::to_string(layers.begin) + " to before " + std::to_string(layers.end) +
              " are asked for, the box has " + std::to_string(shape.nz));
  return static_cast<std::size_t>(std::int64_t{layers.end - layers.begin} * shape.nx * shape.ny);
}

/// @param of_all `components` numbers a node
void copy_layers(const std::vector<double>& of_all, int components, const GridShape& shape, Layers layers,
                 std::span<double> of_layers) {
  const auto first = std::int64_t{components} * shape.nx * shape.ny * layers.begin;
  std::copy_n(of_all.begin() + first, of_layers.size(), of_layers.begin());
}

}  // namespace

void Fluid::moments_of_layers(Layers layers, std::span<double> density, std::span<double> velocity) const {
  const auto n = nodes_of(layers, shape());
  require(density.size() == n && velocity.size() == 3 * n, "moments_of_layers() got room of another size");
  const auto n_all = static_cast<std::size_t>(shape().size());
  std::vector<double> all_density(n_all), all_velocity(3 * n_all);
  moments(all_density, all_velocity);
  copy_layers(all_density, 1, shape(), layers, density);
  copy_layers(all_velocity, 3, shape(), layers, velocity);
}

StateShape Fluid::state_shape() const {
  const auto whole = state();
  StateShape result{whole.step, {}};
  for (const auto& array : whole.arrays) result.arrays.push_back({array.name, array.components});
  return result;
}

void Fluid::state_of_layers(const std::string& array, Layers layers, std::span<double> values) const {
  const auto n = nodes_of(layers, shape());
  const auto whole = state();
  const auto found = std::ranges::find(whole.arrays, array, &StateArray::name);
  require(found != whole.arrays.end(), "the state has no array '" + array + "'");
  require(values.size() == n * static_cast<std::size_t>(found->components),
          "state_of_layers() got room of another size");
  copy_layers(found->values, found->components, shape(), layers, values);
}

void Fluid::restore_from(const StateSource& source) {
  const auto parts = source.shape();
  State whole{parts.step, {}};
  for (const auto& [name, components] : parts.arrays) {
    whole.arrays.push_back({name, components, {}});
    auto& values = whole.arrays.back().values;
    values.resize(static_cast<std::size_t>(components * shape().size()));
    source.read(name, {0, shape().nz}, values);
  }
  source.accepted();
  restore(whole);
}

}  // namespace tanktread::fluid
