#include "fluid/population_halo.hpp"

#include <algorithm>
#include <span>
#include <utility>

#include "fluid/part_border.hpp"

namespace tanktread::fluid {

template <typename Real>
PopulationHalo<Real>::PopulationHalo(PopulationLattice<Real>& lattice, HaloExchange& exchange)
    : lattice_(lattice), exchange_(exchange) {
  const auto directions = halo_directions(lattice.border());
  for (const auto& direction : directions) {
    Neighbour neighbour{runs(direction, false), runs(direction, true), {}, {}};
    std::size_t n = 0;
    for (const Run& run : neighbour.border) n += run.n;
    neighbour.outgoing.resize(n);
    neighbour.incoming.resize(n);
    neighbours_.push_back(std::move(neighbour));
  }
  std::vector<HaloMessage> messages;
  for (std::size_t k = 0; k < neighbours_.size(); ++k) {
    messages.push_back({directions[k], std::as_writable_bytes(std::span(neighbours_[k].outgoing)),
                        std::as_writable_bytes(std::span(neighbours_[k].incoming))});
  }
  exchange_.connect(messages);
}

/// The places f[opposite i](node) of the links i that cross to or from the neighbour, one order for both
/// sides.
template <typename Real>
std::vector<typename PopulationHalo<Real>::Run> PopulationHalo<Real>::runs(std::array<int, 3> direction,
                                                                           bool beyond) const {
  std::vector<Run> found;
  for (const auto& [i, begin, end] : crossing_links(lattice_.border(), direction, beyond)) {
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
