// A user's program in the place of a membrane's laws.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "driver/outside/outside_program.hpp"
#include "driver/packets/membrane_state.hpp"
#include "driver/units/units.hpp"
#include "membrane/membrane.hpp"

namespace tanktread::driver {

/// Gives the nodal forces of a capsule. What goes to and fro: docs/outside-programs.md.
class OutsideMembrane {
 public:
  /// Starts the program. @param number of the capsule in the case @throws InputError if that fails
  OutsideMembrane(const Case& the_case, const Parameters& parameters, std::size_t number);

  /// The total nodal forces, 3 x n, at the positions of `membrane`.
  /// @param velocity that moved the nodes there, 3 x n
  /// @param step of these positions
  /// @throws RunError that names step, program, packet and array
  Eigen::Matrix3Xd forces(const membrane::Membrane& membrane, const Eigen::Matrix3Xd& velocity,
                          std::int64_t step);

  /// What of the last reply is the program's own: all but the forces and what it was given. It comes back to
  /// it in the next packet, and goes to checkpoints.
  const SurfaceArrays& state() const { return state_; }
  /// @throws std::invalid_argument if an array has not a value for each node or triangle of `membrane`
  void restore(SurfaceArrays state, const membrane::Membrane& membrane);

 private:
  exchange::SurfacePacket input(const membrane::Membrane& membrane, const Eigen::Matrix3Xd& velocity,
                                std::int64_t step) const;
  Eigen::Matrix3Xd taken(Reply<exchange::SurfacePacket> reply, const exchange::SurfacePacket& input,
                         std::int64_t step);

  OutsideProgram program_;
  std::vector<exchange::Array> constants_;  ///< field data that every packet has
  double shear_rate_;
  SurfaceArrays state_;
};

}  // namespace tanktread::driver
