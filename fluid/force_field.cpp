#include "fluid/force_field.hpp"

#include <algorithm>

namespace tanktread::fluid {

ForceField::ForceField(const GridShape& shape, const std::array<double, 3>& body_force)
    : nx_(shape.nx),
      body_(body_force),
      has_body_force_(body_force != std::array<double, 3>{0, 0, 0}),
      added_(3 * shape.size(), 0.0),
      row_touched_(shape.size() / shape.nx, 0) {}

void ForceField::add(std::span<const std::int64_t> nodes, std::span<const double> force) {
  std::int64_t row_begin = -nx_;  // of no node
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    for (int component = 0; component < 3; ++component)
      added_[3 * nodes[k] + component] += force[3 * k + component];
    // Nodes mostly follow each other in a row: one division a row, not one a node.
    if (nodes[k] >= row_begin && nodes[k] < row_begin + nx_) continue;
    const std::int64_t row = nodes[k] / nx_;
    row_begin = row * nx_;
    row_touched_[row] = 1;
  }
}

void ForceField::clear() {
  for (std::size_t row = 0; row < row_touched_.size(); ++row) {
    if (!row_touched_[row]) continue;
    std::fill_n(added_.begin() + row * 3 * nx_, 3 * nx_, 0.0);
    row_touched_[row] = 0;
  }
}

void ForceField::restore(std::span<const double> added) {
  added_.assign(added.begin(), added.end());
  std::fill(row_touched_.begin(), row_touched_.end(), 1);
}

bool ForceField::acts_on(std::int64_t row) const {
  if (has_body_force_) return true;
  if (!row_touched_[row]) return false;
  const auto first = added_.begin() + row * 3 * nx_;
  return std::any_of(first, first + 3 * nx_, [](double component) { return component != 0.0; });
}

void ForceField::gather(std::int64_t row, RowForce& target) const {
  for (int x = 0; x < nx_; ++x) {
    const double* force = &added_[3 * (row * nx_ + x)];
    target.x[x] = force[0] + body_[0];
    target.y[x] = force[1] + body_[1];
    target.z[x] = force[2] + body_[2];
  }
  for (auto* component : {&target.x, &target.y, &target.z})
    std::fill(component->begin() + nx_, component->end(), (*component)[nx_ - 1]);
}

}  // namespace tanktread::fluid
