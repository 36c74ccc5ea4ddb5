// The populations that cross the cuts of a part. Internal to fluid/.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "fluid/halo.hpp"
#include "fluid/population_lattice.hpp"

namespace tanktread::fluid {

/// Brings populations across the cuts. In a streaming step a node takes and leaves populations in the places
/// of its neighbours (Turn). Where a neighbour is beyond a cut, these places are in the halo, a layer of
/// nodes around the part:
///   after a local step what neighbours left for us is at the border of their parts: it is brought to the
///   halo;
///   after a streaming step what we left for neighbours is in the halo: it is brought to their border.
/// So one message a neighbour and step goes each way, of the same places each time: five populations a node
/// of a face, one of an edge.
///
/// What goes out is never written over by what comes in, so that a node's outgoing populations
/// (PopulationLattice::get_outgoing) are there at any time. The lattice is borrowed.
template <typename Real>
class PopulationHalo {
 public:
  /// @param exchange borrowed, and connected here; it must be gone before this, whose memory it writes to
  PopulationHalo(PopulationLattice<Real>& lattice, HaloExchange& exchange);

  /// Sends what the last step, of this kind, has left for the neighbours.
  void send(Turn last);

  /// Waits for what send() asked for, and brings it to its place; nothing if it was done before.
  void receive();

 private:
  /// Numbers side by side in a row of the lattice.
  struct Run {
    Real* begin;
    int n;
  };
  /// What is exchanged with one neighbour, in an order that both know.
  struct Neighbour {
    std::vector<Run> border;  ///< ours, which are in its halo
    std::vector<Run> halo;    ///< in our halo, which are at its border
    std::vector<Real> outgoing, incoming;
  };

  std::vector<Run> runs(std::array<int, 3> direction, bool beyond) const;

  PopulationLattice<Real>& lattice_;
  HaloExchange& exchange_;
  std::vector<Neighbour> neighbours_;
  std::optional<Turn> under_way_;  ///< the kind of the step whose populations are being exchanged
};

}  // namespace tanktread::fluid
