// Membrane viscosity as a linear operator: weighted strain rates of the elements from the velocities of the
// nodes, and by its transpose the viscous forces on the nodes.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "membrane/corners_of_node.hpp"
#include "membrane/element.hpp"

namespace tanktread::membrane {

/// The operator B of a surface at the positions it was last given. With D the rate of deformation of the
/// linear velocity field in the plane of an element of area A, mu_s the shear and mu_d the dilatational
/// viscosity, B u has three numbers an element:
///
///     sqrt(A) [sqrt(mu_s) (D11 - D22), 2 sqrt(mu_s) D12, sqrt(mu_d) (D11 + D22)]
///
/// so that |B u|^2 is the power that the viscous stress of Boussinesq and Scriven dissipates (Eq. 2.9),
///
///     tau_v = mu_s (2 D - tr(D) I) + mu_d tr(D) I,
///     A tau_v : D = A [mu_s ((D11 - D22)^2 + 4 D12^2) + mu_d (tr D)^2],
///
/// and the forces of that stress on the nodes are -B^T B u, for any velocities: what they do with other
/// velocities v is -(B v).(B u). B^T B is symmetric and not negative, and zero for rigid motions. It is the
/// law of ViscousLaw with StressMeasure::rate_of_deformation, without its springs; nothing is remembered from
/// step to step.
///
/// Axis 1 is along the edge from corner 0 to corner 1 at the present positions, axis 2 in the plane of the
/// element towards corner 2. Numbers of an element in those axes turn with it, so those of one step fit the
/// next.
///
/// It owns its triangles and knows no reference shape; the surface may be open. Viscosities, positions and
/// times in lattice units. Results do not depend on the number of threads, to the last bit.
class StrainRates {
 public:
  /// @param triangles 3 x n_elements, node numbers from 0 to n_nodes - 1, counter-clockwise seen from outside
  /// @param shear_viscosity, dilatational_viscosity mu_s and mu_d, force times time per length; 0: none
  /// @param threads OpenMP threads, 0: all
  /// @throws std::invalid_argument if a triangle names a node that does not exist, a viscosity is negative or
  /// not finite, or threads is negative
  StrainRates(Eigen::Matrix3Xi triangles, Eigen::Index n_nodes, double shear_viscosity,
              double dilatational_viscosity, int threads = 0);

  Eigen::Index n_nodes() const { return n_nodes_; }
  Eigen::Index n_elements() const { return triangles_.cols(); }

  /// Once a step, and before anything is asked.
  /// @param positions 3 x n_nodes
  /// @throws InvertedElement if the area of an element is below 1/4 10^-12 of the sum of its squared edges,
  /// or a position is not finite; the message names the first such element. The positions before then stay
  /// @throws std::invalid_argument if the number of columns is not n_nodes()
  void set_positions(const Eigen::Ref<const Eigen::Matrix3Xd>& positions);

  /// B u.
  /// @param velocity 3 x n_nodes
  /// @param rates 3 x n_elements, overwritten
  /// @throws std::invalid_argument if an array has another number of columns
  /// @throws std::logic_error if no positions were set
  void multiply(const Eigen::Ref<const Eigen::Matrix3Xd>& velocity, Eigen::Ref<Eigen::Matrix3Xd> rates) const;

  /// B^T s: the viscous forces of s = B u, with the sign turned.
  /// @param rates 3 x n_elements
  /// @param force 3 x n_nodes, overwritten
  /// @throws as multiply()
  void multiply_transposed(const Eigen::Ref<const Eigen::Matrix3Xd>& rates,
                           Eigen::Ref<Eigen::Matrix3Xd> force) const;

 private:
  /// What of an element enters B.
  struct Element {
    SurfaceGradient axes;               ///< the axes in space, columns
    SurfaceGradient weighted_gradient;  ///< sqrt(A) grad N_a in those axes, a row a corner
  };

  Element element_at(const Eigen::Ref<const Eigen::Matrix3Xd>& positions, Eigen::Index t) const;
  static bool has_area(const Element& element);
  void require_positions() const;

  int n_threads_;
  Eigen::Matrix3Xi triangles_;
  Eigen::Index n_nodes_;
  double shear_root_, dilatational_root_;  ///< square roots of the viscosities
  CornersOfNode corners_of_node_;
  std::vector<Element> elements_, next_elements_;  ///< empty before the first positions; scratch
};

}  // namespace tanktread::membrane
