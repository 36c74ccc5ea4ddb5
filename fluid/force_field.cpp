#include "fluid/force_field.hpp"

#include <algorithm>
#include <bit>
#include <new>

namespace tanktread::fluid {
namespace {

/// Whether the nodes of a list are in ascending order, none twice.
bool ascending(std::span<const std::int64_t> nodes, int n_threads) {
  const auto n = static_cast<std::int64_t>(nodes.size());
  bool all = true;
#pragma omp parallel for num_threads(n_threads) schedule(static) reduction(&& : all)
  for (std::int64_t k = 1; k < n; ++k) all = all && nodes[k - 1] < nodes[k];
  return all;
}

}  // namespace

ForceField::ForceField(const GridShape& shape, const std::array<double, 3>& body_force, int threads)
    : nx_(shape.nx),
      n_threads_(threads),
      body_(body_force),
      has_body_force_(body_force != std::array<double, 3>{0, 0, 0}),
      n_numbers_(static_cast<std::size_t>(3 * shape.size())),
      // Of zeros that the system promises, and gives memory for where they are first written.
      added_(static_cast<double*>(std::calloc(n_numbers_, sizeof(double)))),
      reach_(shape.size() / shape.nx, {shape.nx, 0}) {
  if (!added_) throw std::bad_alloc();
}

void ForceField::add(std::span<const std::int64_t> nodes, std::span<const double> force) {
  if (nodes.empty()) return;
  if (!ascending(nodes, n_threads_)) return add_in_rows(nodes, force);
    // A share takes whole rows, so that no row's reach is written by two.
#pragma omp parallel for num_threads(n_threads_) schedule(static)
  for (int share = 0; share < n_threads_; ++share) {
    const auto first_in_share = [&](int number) {
      const std::int64_t from_row = nodes.front() / nx_, rows = nodes.back() / nx_ + 1 - from_row;
      const std::int64_t node = (from_row + rows * number / n_threads_) * nx_;
      return static_cast<std::size_t>(std::lower_bound(nodes.begin(), nodes.end(), node) - nodes.begin());
    };
    const std::size_t begin = first_in_share(share), end = first_in_share(share + 1);
    add_in_rows(nodes.subspan(begin, end - begin), force.subspan(3 * begin, 3 * (end - begin)));
  }
}

void ForceField::add_in_rows(std::span<const std::int64_t> nodes, std::span<const double> force) {
  for (std::size_t k = 0; k < nodes.size();) {
    // The nodes of one row that follow each other in the list: one division for all of them.
    const std::int64_t row = nodes[k] / nx_, row_begin = row * nx_;
    Reach reach = reach_[row];
    for (; k < nodes.size() && nodes[k] >= row_begin && nodes[k] < row_begin + nx_; ++k) {
      for (int component = 0; component < 3; ++component)
        added_[3 * nodes[k] + component] += force[3 * k + component];
      const auto x = static_cast<std::int32_t>(nodes[k] - row_begin);
      reach = {std::min(reach.begin, x), std::max(reach.end, x + 1)};
    }
    reach_[row] = reach;
  }
}

void ForceField::clear() {
#pragma omp parallel for num_threads(n_threads_) schedule(static)
  for (std::int64_t row = 0; row < n_rows(); ++row) {
    auto& reach = reach_[row];
    if (reach.end == 0) continue;
    std::fill(&added_[3 * (row * nx_ + reach.begin)], &added_[3 * (row * nx_ + reach.end)], 0.0);
    reach = {static_cast<std::int32_t>(nx_), 0};
  }
}

void ForceField::restore(std::int64_t first_row, std::span<const double> added) {
  const std::int64_t n = std::ssize(added) / (3 * nx_);
#pragma omp parallel for num_threads(n_threads_) schedule(static)
  for (std::int64_t k = 0; k < n; ++k) {
    const std::int64_t row = first_row + k;
    const auto from = added.subspan(3 * k * nx_, 3 * nx_);
    double* to = &added_[3 * row * nx_];
    auto& reach = reach_[row];
    const bool was_zero = reach.end == 0;
    const bool is_zero =
        std::ranges::all_of(from, [](double force) { return std::bit_cast<std::uint64_t>(force) == 0; });
    reach = is_zero ? Reach{static_cast<std::int32_t>(nx_), 0} : Reach{0, static_cast<std::int32_t>(nx_)};
    if (!is_zero || !was_zero) std::ranges::copy(from, to);
  }
}

}  // namespace tanktread::fluid
