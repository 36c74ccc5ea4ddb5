// A box that several solvers share: the part that one of them holds, and what it tells its neighbours.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "fluid/fluid.hpp"

namespace tanktread::fluid {

/// A block of the nodes of a box. A part is cut along an axis if it does not reach from end to end of it; the
/// parts of a box are those between the same cuts, so that neighbours meet face to face.
struct GridPart {
  std::array<int, 3> begin = {0, 0, 0};  ///< first node along x, y, z
  GridShape shape;                       ///< nodes along x, y, z; nx >= 3, ny >= 1, nz >= 1
};

/// Numbers that go to a neighbour of a part, and as many that come from it, once a step.
struct HaloMessage {
  std::array<int, 3> direction;  ///< where it is: -1, 0 or 1 along x, y, z; round the box if that is periodic
  std::span<std::byte> outgoing;  ///< the neighbour finds it in its message of the opposite direction
  std::span<std::byte> incoming;  ///< as long as `outgoing`
};

/// Carries messages between the parts of a box, which all have one like this. It knows who has which part.
///
/// The parts take the same number of steps. A part may be ahead of its neighbours: what it sends then waits
/// for them, and at most one message a neighbour waits.
class HaloExchange {
 public:
  virtual ~HaloExchange() = default;

  /// Called once, before all else. The memory of the messages belongs to the solver, and stays where it is
  /// until this is gone.
  virtual void connect(std::span<const HaloMessage> messages) = 0;

  /// What is in `outgoing` may go, and `incoming` may be written. Does not wait.
  virtual void start() = 0;

  /// Waits until all of start() has come, and gone.
  virtual void finish() = 0;
};

}  // namespace tanktread::fluid
