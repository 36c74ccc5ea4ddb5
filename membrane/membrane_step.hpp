// The time step of several membranes together.
#pragma once

#include <Eigen/Core>
#include <span>

#include "membrane/membrane.hpp"

namespace tanktread::membrane {

/// What a membrane is given for its time step. All is borrowed.
struct MembraneStep {
  Membrane* membrane;
  const Eigen::Matrix3Xd* positions;  ///< as of set_positions(); null: it stays where it is
  Eigen::Matrix3Xd* force;            ///< overwritten, 3 x n_nodes; null: check_elements() is all
};

/// The time step of membranes, each named once.
/// For each membrane set_positions(), then add_forces() on forces that are zero. All threads (as many as the
/// first membrane was made with) share the elements of all membranes. The forces are those of one membrane
/// after the other, to the last bit.
/// @throws InvertedElement as add_forces(), for the first bad element of the first membrane that has one,
/// with its number in `steps`; forces may then be overwritten, the histories of all membranes are untouched
/// @throws std::invalid_argument if an array has another number of columns than its membrane nodes
void advance(std::span<const MembraneStep> steps);

}  // namespace tanktread::membrane
