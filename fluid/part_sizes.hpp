// What a part of a box takes and exchanges, known without making it.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "fluid/halo.hpp"
#include "fluid/lattice_boltzmann.hpp"

namespace tanktread::fluid {

/// Bytes that go to a neighbour once a step, and as many that come from it.
struct HaloSize {
  std::array<int, 3> direction;  ///< as in HaloMessage
  std::int64_t bytes;
};

struct PartSizes {
  std::int64_t nodes = 0;             ///< of the part
  std::int64_t halo_nodes = 0;        ///< of the layer around it
  std::int64_t population_bytes = 0;  ///< memory of the populations of both, with the padding of rows
  std::vector<HaloSize> messages;     ///< those of the solver's HaloExchange, in its order

  /// Of all messages, one way.
  std::int64_t message_bytes() const;
};

/// By the same functions as make_lattice_boltzmann(settings, part, exchange): what crosses a cut is five
/// populations a node of a face and one a node of an edge, but for those that go to another neighbour.
/// @throws std::invalid_argument as that does
PartSizes part_sizes(const LatticeBoltzmannSettings& settings, const GridPart& part);

}  // namespace tanktread::fluid
