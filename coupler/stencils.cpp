#include "coupler/stencils.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace tanktread::coupler {
namespace {

constexpr std::int32_t untouched = -1;
constexpr std::array<std::int32_t, 2> nothing_reached = {std::numeric_limits<std::int32_t>::max(), -1};

}  // namespace

Stencils::Stencils(const Grid& grid, const Kernel& kernel, int n_threads)
    : grid_(grid),
      kernel_(kernel),
      n_threads_(n_threads),
      n_points_(static_cast<int>(std::ceil(2.0 * kernel.half_width))) {
  for (int axis = 0; axis < 3; ++axis) {
    if (grid.nodes[axis] < n_points_) {
      throw std::invalid_argument("coupler: axis " + std::to_string(axis) + " has " +
                                  std::to_string(grid.nodes[axis]) + " nodes, kernel " + kernel.name +
                                  " needs " + std::to_string(n_points_));
    }
  }
  surface_begin_ = {0};
  place_of_.assign(static_cast<std::size_t>(grid.nodes[0]) * grid.nodes[1] * grid.nodes[2], untouched);
  row_reach_.assign(static_cast<std::size_t>(grid.nodes[1]) * grid.nodes[2], nothing_reached);
}

void Stencils::build(std::span<const std::span<const double>> surfaces) {
  std::vector<std::int64_t> begin = {0};
  for (const auto surface : surfaces)
    begin.push_back(begin.back() + static_cast<std::int64_t>(surface.size() / 3));
  std::vector<Stencil> stencils(begin.back());
  for (std::size_t s = 0; s < surfaces.size(); ++s) {
    const std::int64_t n = begin[s + 1] - begin[s];
    std::int64_t first_bad = n;
#pragma omp parallel for num_threads(n_threads_) schedule(static) reduction(min : first_bad)
    for (std::int64_t node = 0; node < n; ++node) {
      if (!place(&surfaces[s][3 * node], stencils[begin[s] + node])) first_bad = std::min(first_bad, node);
    }
    if (first_bad < n) refuse(s, first_bad, &surfaces[s][3 * first_bad]);
  }
  surface_begin_ = std::move(begin);
  stencils_ = std::move(stencils);
  list_touched();
}

bool Stencils::place(const double* position, Stencil& stencil) const {
  for (int axis = 0; axis < 3; ++axis) {
    const double coordinate = position[axis] - 0.5;  // in node numbers
    const int n = grid_.nodes[axis];
    if (!(std::abs(coordinate) < 1e9)) return false;  // not finite, or past what an int can number
    const double first = std::floor(coordinate - kernel_.half_width) + 1.0;
    auto& weight = stencil.weight[axis];
    weight = {};
    if (kernel_.weights != nullptr) {
      kernel_.weights(first - coordinate, weight.data());
    } else {
      for (int point = 0; point < n_points_; ++point)
        weight[point] = kernel_.function(first + point - coordinate);
    }
    int number = static_cast<int>(first);
    if (grid_.periodic[axis]) {
      number = ((number % n) + n) % n;
    } else if (number < 0 || number + n_points_ > n) {
      return false;
    }
    stencil.first[axis] = number;
  }
  return true;
}

void Stencils::refuse(std::size_t surface, std::int64_t node, const double* position) const {
  std::ostringstream message;
  message << "node " << node << " of surface " << surface << " at (" << position[0] << ", " << position[1]
          << ", " << position[2] << ") ";
  for (int axis = 0; axis < 3; ++axis) {
    if (grid_.periodic[axis] && std::isfinite(position[axis])) continue;
    const double wall_distance = std::min(position[axis], grid_.nodes[axis] - position[axis]);
    if (!std::isfinite(position[axis])) {
      message << "is not finite";
    } else if (wall_distance < kernel_.half_width + 0.5) {
      message << "is " << wall_distance << " grid steps from the wall across "
              << "xyz"[axis] << "; kernel " << kernel_.name << " reaches " << kernel_.half_width
              << " and finds no fluid nodes beyond the wall";
    } else {
      continue;
    }
    throw StencilError(message.str());
  }
  message << "is out of any reach";
  throw StencilError(message.str());
}

void Stencils::list_touched() {
  const int nx = grid_.nodes[0];
  for (const std::int64_t node : touched_) place_of_[node] = untouched;
  touched_.clear();

  for (std::int64_t node = 0; node < n_stencils(); ++node) {
    const auto& first = stencils_[node].first;
    for (int k = 0; k < n_points_; ++k) {
      for (int j = 0; j < n_points_; ++j) {
        const int y = wrapped(first[1] + j, 1), z = plane(node, k);
        auto& reach = row_reach_[std::int64_t{z} * grid_.nodes[1] + y];
        std::int32_t* row = &place_of_[index(0, y, z)];
        for (int i = 0; i < n_points_; ++i) {
          const int x = wrapped(first[0] + i, 0);
          row[x] = 0;
          reach[0] = std::min(reach[0], x);
          reach[1] = std::max(reach[1], x);
        }
      }
    }
  }
  for (std::size_t row = 0; row < row_reach_.size(); ++row) {
    for (std::int32_t x = row_reach_[row][0]; x <= row_reach_[row][1]; ++x) {
      const std::int64_t node = static_cast<std::int64_t>(row) * nx + x;
      if (place_of_[node] == untouched) continue;
      place_of_[node] = static_cast<std::int32_t>(touched_.size());
      touched_.push_back(node);
    }
    row_reach_[row] = nothing_reached;
  }

  runs_.resize(stencils_.size() * most_points * most_points);
#pragma omp parallel for num_threads(n_threads_) schedule(static)
  for (std::int64_t node = 0; node < n_stencils(); ++node) {
    const auto& first = stencils_[node].first;
    for (int k = 0; k < n_points_; ++k) {
      for (int j = 0; j < n_points_; ++j) {
        const std::int64_t row = index(0, wrapped(first[1] + j, 1), plane(node, k));
        runs_[(node * most_points + k) * most_points + j] = {place_of_[row + first[0]], place_of_[row]};
      }
    }
  }
}

}  // namespace tanktread::coupler
