// Membrane viscosity as a linear operator: weighted strain rates of the elements or at the nodes from the
// velocities of the nodes, and by its transpose the viscous forces on the nodes.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "membrane/corners_of_node.hpp"
#include "membrane/viscous_parameters.hpp"

namespace tanktread::membrane {

struct ElementRates;
struct TangentPlane;

/// The operator B of a surface at the positions it was last given. With mu_s the shear and mu_d the
/// dilatational viscosity and D a rate of deformation over an area A, B u has three numbers for each D:
///
///     sqrt(A) [sqrt(mu_s) (D11 - D22), 2 sqrt(mu_s) D12, sqrt(mu_d) (D11 + D22)]
///
/// so that |B u|^2 is the power that the viscous stress of Boussinesq and Scriven dissipates (Eq. 2.9),
///
///     tau_v = mu_s (2 D - tr(D) I) + mu_d tr(D) I,
///     A tau_v : D = A [mu_s ((D11 - D22)^2 + 4 D12^2) + mu_d (tr D)^2],
///
/// and the forces of that stress on the nodes are -B^T B u, for any velocities: what they do with other
/// velocities v is -(B v).(B u). B^T B is symmetric and not negative, and zero for rigid motions. Nothing is
/// remembered from step to step.
///
/// RatesAt::elements: A and D = D_t are those of each triangle and of the linear velocity field in its plane.
/// It is the law of ViscousLaw with StressMeasure::rate_of_deformation, without its springs. Flat triangles
/// lock: where the membrane moves along its normal they are sheared and it is not, so that there is a false
/// power, of second order in the edge. Axis 1 is along the edge from corner 0 to corner 1 at the present
/// positions, axis 2 in the plane of the element towards corner 2.
///
/// RatesAt::nodes: of the triangles t around a node m
///
///     A_m = sum A_t/3,   D_m = Q_m^T [sum (A_t/3) D_t / A_m] Q_m,
///
/// D_t in space and Q_m (3 x 2) the axes of the tangent plane. Its normal is the area-weighted one of the
/// triangles around; axis 1 is along the edge from the node to the next corner of its first triangle (the
/// least t), projected on the plane; axis 2 is normal x axis 1. What neighbours are sheared falsely cancels
/// in the mean.
///
/// Limit of the mean: it hardly sees waves of about two edges, along or normal to the surface. With mu_d > 0
/// an icosphere has six fields of such waves, besides the rigid ones, with B u = 0 to rounding; deformed, it
/// has none, but short waves down to 10^-3 of the largest |B u|/|u| and below. Elasticity or the fluid must
/// damp them. (With mu_d = 0 B u = 0 has about n_nodes solutions, as it must: any motion along the normal,
/// with the tangential one that undoes its shear. Triangles have one.)
///
/// Numbers turn with their axes, so those of one step fit the next.
///
/// It owns its triangles and knows no reference shape; the surface may be open. Viscosities, positions and
/// times in lattice units. Results do not depend on the number of threads, to the last bit. An object has
/// scratch memory of its own: one call at a time.
class StrainRates {
 public:
  /// @param triangles 3 x n_elements, node numbers from 0 to n_nodes - 1, counter-clockwise seen from outside
  /// @param shear_viscosity, dilatational_viscosity mu_s and mu_d, force times time per length; 0: none
  /// @param threads OpenMP threads, 0: all
  /// @throws std::invalid_argument if a triangle names a node that does not exist, a node has no triangle
  /// (RatesAt::nodes), a viscosity is negative or not finite, or threads is negative
  StrainRates(Eigen::Matrix3Xi triangles, Eigen::Index n_nodes, double shear_viscosity,
              double dilatational_viscosity, RatesAt at = RatesAt::nodes, int threads = 0);
  ~StrainRates();
  StrainRates(const StrainRates&);
  StrainRates& operator=(const StrainRates&);
  StrainRates(StrainRates&&) noexcept;
  StrainRates& operator=(StrainRates&&) noexcept;

  Eigen::Index n_nodes() const { return n_nodes_; }
  Eigen::Index n_elements() const { return triangles_.cols(); }
  /// Columns of the arrays of rates: n_elements() or n_nodes().
  Eigen::Index n_rates() const { return at_ == RatesAt::nodes ? n_nodes() : n_elements(); }

  /// Once a step, and before anything is asked.
  /// @param positions 3 x n_nodes
  /// @throws InvertedElement if the area of an element is below 1/4 10^-12 of the sum of its squared edges,
  /// a position is not finite, or a node has no tangent_plane() (RatesAt::nodes); the message names the first
  /// such element or node. The positions before then stay
  /// @throws std::invalid_argument if the number of columns is not n_nodes()
  void set_positions(const Eigen::Ref<const Eigen::Matrix3Xd>& positions);

  /// B u.
  /// @param velocity 3 x n_nodes
  /// @param rates 3 x n_rates, overwritten
  /// @throws std::invalid_argument if an array has another number of columns
  /// @throws std::logic_error if no positions were set
  void multiply(const Eigen::Ref<const Eigen::Matrix3Xd>& velocity, Eigen::Ref<Eigen::Matrix3Xd> rates) const;

  /// B^T s: the viscous forces of s = B u, with the sign turned.
  /// @param rates 3 x n_rates
  /// @param force 3 x n_nodes, overwritten
  /// @throws as multiply()
  void multiply_transposed(const Eigen::Ref<const Eigen::Matrix3Xd>& rates,
                           Eigen::Ref<Eigen::Matrix3Xd> force) const;

  /// Cauchy stress tensors tau_v of the elements in space, row by row (as ElementFields::viscous_stress),
  /// force per length, of the rates s = B u. By nodes: the mean over the three nodes of an element, each in
  /// its own tangent plane. In both forms the sum of A_t stress_t : D_t over the elements is |B u|^2.
  /// @param rates 3 x n_rates
  /// @throws as multiply()
  Eigen::Matrix<double, 9, Eigen::Dynamic> stress(const Eigen::Ref<const Eigen::Matrix3Xd>& rates) const;

  /// Takes numbers that were of the positions before the last set_positions() to the present ones: the same
  /// stress an element or node, which turns with the material, and the present areas as weights. The turn is
  /// the polar rotation of the motion in between (at a node of the mean over the triangles around, weighted
  /// by their areas), so that it is the same however edges are numbered; for small steps the spin of the
  /// material, as in the rate of Jaumann.
  /// @param rates 3 x n_rates
  /// @throws std::logic_error if positions were set less than twice; as multiply()
  void carry(Eigen::Ref<Eigen::Matrix3Xd> rates) const;

 private:
  /// The surface at its present positions. Of the nodes: empty with RatesAt::elements.
  struct Surface {
    std::vector<ElementRates> elements;  ///< empty before the first positions
    std::vector<TangentPlane> planes;
    /// By 3 element + corner: weighted_rates() of the element -> its share in the column of the node.
    std::vector<Eigen::Matrix3d> to_node;
  };

  void find_elements(const Eigen::Ref<const Eigen::Matrix3Xd>& positions, Surface& surface) const;
  void find_planes(const Eigen::Ref<const Eigen::Matrix3Xd>& positions, Surface& surface) const;
  void find_shares(Surface& surface) const;
  void require_positions() const;

  RatesAt at_;
  int n_threads_;
  Eigen::Matrix3Xi triangles_;
  Eigen::Index n_nodes_;
  Eigen::Vector3d roots_;  ///< square roots of the viscosities: shear, shear, dilatational
  CornersOfNode corners_of_node_;
  Surface surface_, next_surface_;       ///< now; the one before, and scratch
  mutable Eigen::Matrix3Xd of_corners_;  ///< scratch, by 3 element + corner
};

}  // namespace tanktread::membrane
