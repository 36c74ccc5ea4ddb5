#include "fluid/population_halo.hpp"

#include <algorithm>
#include <span>
#include <utility>

namespace tanktread::fluid {
namespace {

constexpr int n_axes = 3;

/// Populations along direction i cross the cuts that a neighbour in `direction` lies behind, and no other.
bool goes_along(int i, const std::array<int, n_axes>& direction) {
  for (int axis = 0; axis < n_axes; ++axis)
    if (direction[axis] != 0 && d3q19::velocity[i][axis] != direction[axis]) return false;
  return true;
}

}  // namespace

template <typename Real>
PopulationHalo<Real>::PopulationHalo(PopulationLattice<Real>& lattice, HaloExchange& exchange)
    : lattice_(lattice), exchange_(exchange) {
  std::vector<std::array<int, n_axes>> directions;
  for (int z = -1; z <= 1; ++z) {
    for (int y = -1; y <= 1; ++y) {
      for (int x = -1; x <= 1; ++x) {
        const std::array<int, n_axes> direction = {x, y, z};
        if (!lattice.has_neighbour(direction)) continue;
        Neighbour neighbour{runs(direction, false), runs(direction, true), {}, {}};
        std::size_t n = 0;
        for (const Run& run : neighbour.border) n += run.n;
        if (n == 0) continue;
        neighbour.outgoing.resize(n);
        neighbour.incoming.resize(n);
        neighbours_.push_back(std::move(neighbour));
        directions.push_back(direction);
      }
    }
  }
  std::vector<HaloMessage> messages;
  for (std::size_t k = 0; k < neighbours_.size(); ++k) {
    messages.push_back({directions[k], std::as_writable_bytes(std::span(neighbours_[k].outgoing)),
                        std::as_writable_bytes(std::span(neighbours_[k].incoming))});
  }
  exchange_.connect(messages);
}

/// The places f[opposite i](node) of the links i that cross to or from the neighbour, one order for both
/// sides. At our border (`beyond` false) a link leaves towards it, in our halo one comes from it. Along the
/// other axes a link must not leave the part: there another neighbour has it, or a wall keeps it.
template <typename Real>
std::vector<typename PopulationHalo<Real>::Run> PopulationHalo<Real>::runs(std::array<int, 3> direction,
                                                                           bool beyond) const {
  const std::array<int, n_axes> n = {lattice_.shape().nx, lattice_.shape().ny, lattice_.shape().nz};
  std::array<int, n_axes> along = direction;
  if (beyond) {
    for (int& component : along) component = -component;
  }
  std::vector<Run> found;
  for (int i = 1; i < d3q19::n_directions; ++i) {
    if (!goes_along(i, along)) continue;
    std::array<int, n_axes> begin, end;
    for (int axis = 0; axis < n_axes; ++axis) {
      const int c = d3q19::velocity[i][axis];
      if (direction[axis] != 0) {
        begin[axis] = direction[axis] < 0 ? (beyond ? -1 : 0) : n[axis] - (beyond ? 0 : 1);
        end[axis] = begin[axis] + 1;
      } else {
        const bool wraps = lattice_.wraps(axis);
        begin[axis] = wraps ? 0 : std::max(0, -c);
        end[axis] = wraps ? n[axis] : n[axis] - std::max(0, c);
      }
    }
    if (begin[0] >= end[0]) continue;
    for (int z = begin[2]; z < end[2]; ++z)
      for (int y = begin[1]; y < end[1]; ++y)
        found.push_back({lattice_.row(d3q19::opposite(i), y, z) + begin[0], end[0] - begin[0]});
  }
  return found;
}

template <typename Real>
void PopulationHalo<Real>::send(Turn last) {
  for (Neighbour& neighbour : neighbours_) {
    Real* to = neighbour.outgoing.data();
    for (const Run& run : last == Turn::local ? neighbour.border : neighbour.halo)
      to = std::copy_n(run.begin, run.n, to);
  }
  exchange_.start();
  under_way_ = last;
}

template <typename Real>
void PopulationHalo<Real>::receive() {
  if (!under_way_) return;
  exchange_.finish();
  for (Neighbour& neighbour : neighbours_) {
    const Real* from = neighbour.incoming.data();
    for (const Run& run : *under_way_ == Turn::local ? neighbour.halo : neighbour.border) {
      std::copy_n(from, run.n, run.begin);
      from += run.n;
    }
  }
  under_way_.reset();
}

template class PopulationHalo<double>;
template class PopulationHalo<float>;

}  // namespace tanktread::fluid
