#include "fluid/force_field.hpp"

#include <algorithm>

namespace tanktread::fluid {

ForceField::ForceField(const GridShape& shape, const std::array<double, 3>& body_force)
    : nx_(shape.nx),
      body_(body_force),
      has_body_force_(body_force != std::array<double, 3>{0, 0, 0}),
      added_(3 * shape.size(), 0.0),
      begin_(shape.size() / shape.nx, shape.nx),
      end_(shape.size() / shape.nx, 0) {}

void ForceField::add(std::span<const std::int64_t> nodes, std::span<const double> force) {
  std::int64_t row = 0, row_begin = -nx_;  // of no node
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    for (int component = 0; component < 3; ++component)
      added_[3 * nodes[k] + component] += force[3 * k + component];
    // Nodes mostly follow each other in a row: one division a row, not one a node.
    if (nodes[k] < row_begin || nodes[k] >= row_begin + nx_) {
      row = nodes[k] / nx_;
      row_begin = row * nx_;
    }
    const auto x = static_cast<std::int32_t>(nodes[k] - row_begin);
    begin_[row] = std::min(begin_[row], x);
    end_[row] = std::max(end_[row], x + 1);
  }
}

void ForceField::clear() {
  for (std::size_t row = 0; row < end_.size(); ++row) {
    if (end_[row] == 0) continue;
    std::fill(added_.begin() + 3 * (row * nx_ + begin_[row]), added_.begin() + 3 * (row * nx_ + end_[row]),
              0.0);
    begin_[row] = static_cast<std::int32_t>(nx_);
    end_[row] = 0;
  }
}

void ForceField::restore(std::span<const double> added) {
  added_.assign(added.begin(), added.end());
  std::fill(begin_.begin(), begin_.end(), 0);
  std::fill(end_.begin(), end_.end(), static_cast<std::int32_t>(nx_));
}

}  // namespace tanktread::fluid
