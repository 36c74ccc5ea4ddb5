// The viscous forces that depend on the velocity of their own time, found by membrane, coupler and fluid
// together.
#pragma once

#include <span>
#include <stdexcept>
#include <vector>

#include "coupler/coupler.hpp"
#include "driver/case/case.hpp"
#include "driver/packets/packets.hpp"
#include "driver/system/capsule_membrane.hpp"
#include "driver/system/node_corrections.hpp"

namespace tanktread::driver {

/// How far the equations of the implicit viscosity are solved, by coupler.implicit_tolerance and
/// coupler.implicit_iterations.
struct ImplicitSettings {
  double tolerance =
      0;  ///< of the rates: |B u - s| over |B u|, with theta s(t) in B u where there is a spring
  int most_iterations = 0;
  int threads = 1;
};
ImplicitSettings implicit_settings(const Case& the_case);

/// What the equations ask of coupler and fluid, whoever has them: all of them one process, or each rank a
/// part.
class NodeMobility {
 public:
  virtual ~NodeMobility() = default;
  NodeMobility() = default;
  NodeMobility(const NodeMobility&) = delete;
  NodeMobility& operator=(const NodeMobility&) = delete;

  /// u = M F, or v + M F with the free velocity v of the fluid, on the nodes of the membranes.
  /// @param velocity of the sizes of `force`, overwritten
  virtual void velocity_of(const NodeVectors& force, bool with_free, NodeVectors& velocity) = 0;

  /// The sum of a number of each membrane over all membranes of the case, in their order.
  virtual double sum(std::span<const double> of_membranes) const = 0;
};

/// The equations were not solved. The message says how far they were.
class NotConverged : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Adds the implicit viscous forces at x(t+1). With B and theta of the membranes (ImplicitViscosity), F0 the
/// forces given, u0 the velocity of the nodes at t+1 without those to be found, and M F what nodal forces add
/// to it,
///
///     M F = sum_f delta(x_f - x_m) m_f sum_n delta(x_f - x_n) F_n + (tangential correction by F),
///     u0  = sum_f delta(x_f - x_m) v_f + M F0,
///     (1 + theta + B M B^T) s = B u0 + theta s(t),        F = F0 - B^T s,
///
/// by conjugate gradients from 2 s(t) - s(t-1), until s is the stress of that velocity u = u0 - M B^T s but
/// for the tolerance. v and m are the free velocity of the fluid and its mobility, so that u0
/// - M B^T s is the velocity that the next step finds there. All membranes are solved for together, for each
/// moves the nodes of the others.
/// What coupler.keep_volume moves besides is not in u.
/// @param membranes at x(t+1); those with an implicit viscosity take s(t+1)
/// @param coupler with the stencils at x(t+1)
/// @param free velocity and mobility (Packet::free_velocity) on the nodes that the stencils touch, or more
/// @param force F0 in, F out
/// @return the number of iterations
/// @throws NotConverged, coupler::CorrectionError, membrane::InvertedElement; std::invalid_argument if a grid
/// node that a stencil touches is missing
int add_implicit_forces(std::vector<CapsuleMembrane>& membranes, const coupler::Coupler& coupler,
                        const NodeCorrections& corrections, const GridVectors& free,
                        const ImplicitSettings& settings, NodeVectors& force);

/// What forces on grid nodes do to these: the velocity m F, or v + m F.
/// @param free v and m @param on_grid F in, velocity out, 3 numbers a node of `free`
void move_freely(const GridVectors& free, bool with_free, int threads, std::span<double> on_grid);

/// The same as add_implicit_forces() above with a mobility of any kind. @throws NotConverged
int add_implicit_forces(std::vector<CapsuleMembrane>& membranes, NodeMobility& mobility,
                        const ImplicitSettings& settings, NodeVectors& force);

}  // namespace tanktread::driver
