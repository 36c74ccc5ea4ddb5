// What a kernel takes off the velocity of nodes that push the fluid along their surface, and how to give it
// back.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "coupler/coupler.hpp"

namespace tanktread::coupler {

/// A node has no normal, or a force that is not finite. The message says surface and node.
class CorrectionError : public std::runtime_error {
 public:
  explicit CorrectionError(const std::string& message, std::uint64_t the_precedence = 0)
      : std::runtime_error(message), precedence(the_precedence) {}
  /// As of a StencilError: of those of all parts of a grid, the lowest is that of the whole grid.
  std::uint64_t precedence = 0;
};

/// Across a surface that pushes the fluid along itself with a force f an area, the velocity has a kink:
/// u(s) = u(0) - f |s|/(2 mu). A kernel spreads the force over some grid steps and takes the velocity from as
/// many, so that a node gets less than u(0), by C f/mu with
///
///     C = 1/2 sum_i sum_j phi(i - s) phi(j - s) |i - j|
///
/// in grid steps, where s is the phase of the node between grid nodes; this is the mean over all phases. An
/// error of first order in the grid step; along the normal the velocity has no kink.
double tangential_shortfall(const Kernel& kernel);

/// The shortfall, added to the velocity of the nodes of all surfaces. The force an area is that on the grid,
/// taken at the nodes and divided by the sum S of phi^2 (its mean over the phases), so that it is as smooth
/// as the velocity, and no short wave of the nodes moves that the grid does not carry:
///
///     u_m += C/(mu S) P_m sum_f delta(x_f - x_m) sum_n delta(x_f - x_n) P_n F_n,    P = I - n n^T
///
/// Surfaces may have shortfalls K of their own in the place of C/mu: K is then sqrt(K_m K_n), which is the
/// same within a surface and leaves the mobility symmetric between two. The dipoles of a surface
/// (ShearDipole) are in K, and not in these sums.
///
/// The added mobility is symmetric and not negative. sum_m F_m.u_m over the added part is what the sharp flow
/// dissipates more than the smoothed one. Results do not depend on the number of threads, to the last bit.
class TangentialCorrection {
 public:
  /// @param coupler whose kernel is meant
  /// @param viscosity dynamic, mu of the fluid on both sides, lattice units
  /// @throws std::invalid_argument unless the viscosity is positive and finite
  TangentialCorrection(const Coupler& coupler, double viscosity);

  /// What each surface, or all, has in the place of C/mu.
  struct Shortfalls {
    std::vector<double> of_surfaces;  ///< of tangential_shortfall(); one a surface, or one for all
  };
  /// @throws std::invalid_argument if there is none, or one is negative or not finite
  TangentialCorrection(const Coupler& coupler, const Shortfalls& shortfalls);

  /// @param coupler of the same kernel, with its stencils at the positions of the nodes; all arrays as its
  /// own
  /// @param normals of node_normals() or NodeNormals
  /// @param force F_m, that went into the fluid in the step whose velocity it is
  /// @param velocity to which it is added
  /// @throws CorrectionError if a normal or a force is not finite; nothing is added then
  /// @throws std::invalid_argument if the kernel is another, or an array has another size than the stencils
  /// need
  void add(const Coupler& coupler, std::span<const std::span<const double>> normals,
           std::span<const std::span<const double>> force, std::span<const std::span<double>> velocity) const;

  /// add() in two, for those who must complete the numbers on the grid between: with a coupler of a part,
  /// those at nodes of its region outside of the part are of no use, and come from the parts that they are
  /// in.
  /// @param normals, force looked at where nodes have stencils
  /// @param on_grid 3 x grid_nodes() of the coupler, overwritten
  /// @throws CorrectionError, std::invalid_argument as add()
  void spread(const Coupler& coupler, std::span<const std::span<const double>> normals,
              std::span<const std::span<const double>> force, std::span<double> on_grid) const;
  /// @param on_grid what spread() wrote, complete
  /// @param velocity to which it is added, at the nodes at home
  /// @throws std::invalid_argument as add()
  void add_from(const Coupler& coupler, std::span<const std::span<const double>> normals,
                std::span<const double> on_grid, std::span<const std::span<double>> velocity) const;

 private:
  /// C/(mu S), or K/S, as two factors, one for the forces and one for the velocities of a surface.
  struct Mobility {
    double of_forces, of_velocities;
  };
  void check_kernel(const Coupler& coupler) const;
  void check(const Coupler& coupler, std::size_t n_on_grid) const;
  static void require_finite(const Coupler& coupler, std::span<const std::span<const double>> normals,
                             std::span<const std::span<const double>> force);
  const Mobility& mobility(std::size_t surface) const {
    return mobilities_[mobilities_.size() == 1 ? 0 : surface];
  }

  Kernel kernel_;
  std::vector<Mobility> mobilities_;  ///< of each surface, or one for all
  std::size_t n_surfaces_ = 0;        ///< that shortfalls were given for; 0: for any number
  /// The force on the grid while add() is at work: memory that is used again. So two threads may not be in it
  /// at once.
  std::unique_ptr<std::vector<double>> on_grid_ = std::make_unique<std::vector<double>>();
};

}  // namespace tanktread::coupler
