// What a solver without a way of its own does when it is asked for parts: all, of which it gives a part.
#include "fluid/fluid.hpp"

#include <algorithm>
#include <stdexcept>
#include <vector>

#include "fluid/border_checks.hpp"

namespace tanktread::fluid {
namespace {

/// @param of_all `components` numbers a node
void copy_layers(const std::vector<double>& of_all, int components, const GridShape& shape, Layers layers,
                 std::span<double> of_layers) {
  const auto first = std::int64_t{components} * shape.nx * shape.ny * layers.begin;
  std::copy_n(of_all.begin() + first, of_layers.size(), of_layers.begin());
}

}  // namespace

void Fluid::moments_of_layers(Layers layers, std::span<double> density, std::span<double> velocity) const {
  const auto n = check_layers("moments_of_layers()", layers, shape());
  check_size("moments_of_layers(): density", density.size(), n);
  check_size("moments_of_layers(): velocity", velocity.size(), 3 * n);
  const auto n_all = static_cast<std::size_t>(shape().size());
  std::vector<double> all_density(n_all), all_velocity(3 * n_all);
  moments(all_density, all_velocity);
  copy_layers(all_density, 1, shape(), layers, density);
  copy_layers(all_velocity, 3, shape(), layers, velocity);
}

StateShape Fluid::state_shape() const {
  return shape_of(state());
}

void Fluid::state_of_layers(const std::string& array, Layers layers, std::span<double> values) const {
  const auto n = check_layers("state_of_layers()", layers, shape());
  const auto whole = state();
  const auto found = std::ranges::find(whole.arrays, array, &StateArray::name);
  if (found == whole.arrays.end())
    throw std::invalid_argument("fluid: the state has no array '" + array + "'");
  check_size("state_of_layers(): '" + array + "'", values.size(), found->components * n);
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
