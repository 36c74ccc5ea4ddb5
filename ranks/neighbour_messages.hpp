// The same messages to and from neighbours, over and over.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "ranks/division.hpp"
#include "ranks/world.hpp"

namespace tanktread::ranks {

/// Memory that goes to a neighbour, and as much that comes from it.
struct NeighbourMessage {
  Triple direction;  ///< where it is (Division::neighbour); no two messages have the same
  std::span<const std::byte> outgoing;
  std::span<std::byte> incoming;
};

/// Requests that are made once and started again and again: point to point, a tag a direction, so that two
/// messages between the same two ranks are not mistaken. (Neighbour collectives would do the same; in Open
/// MPI 4.1.4 and MPICH 4.0 some of them mix up sides where an axis has one or two ranks.)
class NeighbourMessages {
 public:
  /// Every rank makes one, together, with the messages that its neighbours make too. World and memory are
  /// borrowed. All destroy theirs together, after finish(); one that is destroyed with messages under way, in
  /// the middle of an error, gives them up and waits for nobody.
  /// @throws std::logic_error for a neighbour that there is not, or messages without MPI
  NeighbourMessages(const World& world, const Division& division, std::span<const NeighbourMessage> messages);
  ~NeighbourMessages();
  NeighbourMessages(const NeighbourMessages&) = delete;
  NeighbourMessages& operator=(const NeighbourMessages&) = delete;

  /// Begins to send and to receive; does not wait. To be called again after finish() only.
  void start();

  /// Waits until all of start() has come and gone.
  void finish();

 private:
  struct Requests;
  std::unique_ptr<Requests> requests_;
};

}  // namespace tanktread::ranks
