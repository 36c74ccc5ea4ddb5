// The way of a packet from one phase to the next.
#pragma once

#include "driver/packets/packets.hpp"

namespace tanktread::driver {

struct System;

/// What happens to the packets of a step on their way. This one hands them on in memory, untouched; others
/// also write them to files, or hand on what they read back from there.
class Passage {
 public:
  virtual ~Passage() = default;

  /// @param system at work on the step from `system.step` to the next: positions are x(t) until the packet
  /// `positions` has passed, x(t+1) from then on
  virtual void pass(const System& system, Packet packet, GridVectors& vectors);
  virtual void pass(const System& system, Packet packet, NodeVectors& vectors);
  virtual void pass(const System& system, Packet packet, GridMarks& marks);

  /// The step is done: `system` stands at its end.
  virtual void step_done(const System& system);

  /// The run ends here, before its time: `system` stands at the end of its last step.
  virtual void stopped(const System& system);
};

inline void Passage::pass(const System&, Packet, GridVectors&) {}
inline void Passage::pass(const System&, Packet, NodeVectors&) {}
inline void Passage::pass(const System&, Packet, GridMarks&) {}
inline void Passage::step_done(const System&) {}
inline void Passage::stopped(const System&) {}

}  // namespace tanktread::driver
