// Nodes of a membrane that move against a drag, in place of a fluid.
#pragma once

#include <Eigen/Core>

#include "membrane/strain_rates.hpp"

namespace tanktread::membrane {

/// A drag zeta per area on every node: with the areas A of the nodes (node_areas()) their velocities u under
/// forces F are
///
///     zeta A u = F,
///
/// and with membrane viscosity (the operator B of StrainRates), whose forces are -B^T B u,
///
///     (zeta A + B^T B) u = F.
///
/// The matrix is symmetric and positive; it is solved by conjugate gradients, with zeta A as preconditioner.
/// Results do not depend on the number of threads, to the last bit.
class NodeDrag {
 public:
  /// @param triangles 3 x n_triangles; every node must be in one
  /// @param drag zeta, force times time per length^3 @throws std::invalid_argument unless it is positive
  NodeDrag(Eigen::Matrix3Xi triangles, double drag);

  /// The areas are of these positions from now on. @param positions 3 x n_nodes
  void set_positions(const Eigen::Ref<const Eigen::Matrix3Xd>& positions);
  double drag() const { return drag_; }
  /// zeta A, an entry a node.
  const Eigen::VectorXd& coefficients() const { return coefficients_; }

  /// u without viscosity. @param force 3 x n_nodes
  Eigen::Matrix3Xd velocity(const Eigen::Matrix3Xd& force) const;

  /// What conjugate gradients came to.
  struct Solution {
    int n_iterations = 0;
    double error = 0;  ///< bound of |error of u|/|u|, both as sqrt(sum zeta A u^2)
  };
  /// u with viscosity.
  /// @param rates B of the present positions
  /// @param velocity where to begin, 3 x n_nodes; overwritten with u
  /// @param tolerance of Solution::error, at which it is solved
  Solution solve(const Eigen::Matrix3Xd& force, const StrainRates& rates, double tolerance,
                 int most_iterations, Eigen::Matrix3Xd& velocity) const;

 private:
  Eigen::Matrix3Xi triangles_;
  double drag_;
  Eigen::VectorXd coefficients_;
};

}  // namespace tanktread::membrane
