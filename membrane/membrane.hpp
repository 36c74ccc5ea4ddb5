// The border of the membrane component: a surface of linear triangles with its law, positions in, forces out.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <span>
#include <stdexcept>
#include <vector>

#include "membrane/elastic_law.hpp"
#include "membrane/energy_terms.hpp"
#include "membrane/mesh.hpp"
#include "membrane/viscous_power.hpp"

namespace tanktread::membrane {

struct MembraneStep;
class ViscousLaw;

/// An element collapsed or turned inside out, or a position is not finite. The message names the element.
class InvertedElement : public std::runtime_error {
 public:
  /// @param membrane of several, the number of the one that it is of
  explicit InvertedElement(const std::string& message, std::size_t membrane = 0)
      : std::runtime_error(message), membrane_(membrane) {}
  std::size_t membrane() const { return membrane_; }

 private:
  std::size_t membrane_;
};

/// Results a person looks at, one column (or entry) an element.
struct ElementFields {
  Eigen::Matrix2Xd principal_stretches;  ///< lambda1 >= lambda2
  /// Cauchy stress tensors in space (row by row), force per length: the total (Eq. 2.25), and its viscous
  /// part (zero without a viscous law).
  Eigen::Matrix<double, 9, Eigen::Dynamic> stress, viscous_stress;
  Eigen::VectorXd area_ratio;  ///< current over reference area
};

/// One closed membrane. It owns its triangles, reference shape, laws and history; units are lattice units.
/// Forces are total forces on the nodes (not densities), added into the target, which the caller clears.
class Membrane {
 public:
  /// @param reference the stress-free shape; its points are also the first positions, but for begin_at()
  /// @param law must not be null
  /// @param threads OpenMP threads, 0: all; no result depends on it, to the last bit
  /// @throws std::invalid_argument if the mesh has no triangle, a triangle names a node that does not exist
  /// or a point is not finite (inspect()), if it has defects(), if the law is null, or threads is negative
  Membrane(TriangleMesh reference, std::shared_ptr<const ElasticLaw> law, int threads = 0);

  /// The same with membrane viscosity. @param viscous may be empty: none
  Membrane(TriangleMesh reference, std::shared_ptr<const ElasticLaw> law,
           std::shared_ptr<const ViscousLaw> viscous, int threads = 0);
  ~Membrane();
  Membrane(Membrane&&) noexcept;
  Membrane& operator=(Membrane&&) noexcept;

  /// Energies of the whole membrane beside its law, whose forces then are part of those of a step. Their
  /// areas and volume at rest are those of the mesh that they were made of, which need not be the stress-free
  /// shape. They have no history. @param terms may be empty: none
  /// @throws std::invalid_argument if they are of other triangles
  void set_energy_terms(std::unique_ptr<EnergyTerms> terms);

  int n_nodes() const;
  int n_triangles() const;
  const TriangleMesh& reference() const;  ///< the stress-free shape
  const ElasticLaw& elastic_law() const;
  const ViscousLaw* viscous_law() const;    ///< owned by the membrane; null: none
  const EnergyTerms* energy_terms() const;  ///< likewise

  /// Current positions, 3 x n_nodes.
  const Eigen::Matrix3Xd& positions() const;
  /// @throws std::invalid_argument if the number of columns is not n_nodes()
  void set_positions(const Eigen::Ref<const Eigen::Matrix3Xd>& positions);

  /// Begins anew at these positions, as a membrane does whose first shape is not the stress-free one: the
  /// first check of elements compares with their normals, and a viscous law counts strain from there, with no
  /// viscous stress. At the reference it is as newly made, to the last bit.
  /// @throws std::invalid_argument if the number of columns is not n_nodes()
  void begin_at(const Eigen::Ref<const Eigen::Matrix3Xd>& positions);

  /// The time step of a membrane: takes the strains at the present positions into the history of the viscous
  /// law (once a step, then, and never twice for the same time), and adds the nodal forces of the total
  /// stress and of the energy terms into `force` (3 x n_nodes).
  /// @throws InvertedElement if an element has less than a thousandth of its reference area, its normal has
  /// turned by a right angle or more since the last call (the first call compares with the reference, or with
  /// the shape of begin_at()), or a position is not finite; the message names the first such element. Force
  /// and history are untouched then
  /// @throws std::invalid_argument if `force` has another number of columns
  void add_forces(Eigen::Ref<Eigen::Matrix3Xd> force);

  /// The check of add_forces() alone, once a step, for a membrane whose forces come from elsewhere.
  /// @throws InvertedElement as there
  void check_elements();

  /// The part of the elastic law alone, for output. It checks no element.
  void add_elastic_forces(Eigen::Ref<Eigen::Matrix3Xd> force) const;

  /// Sum over elements of A0 W.
  double elastic_energy() const;

  /// The energy of each of the energy terms at the present positions, in their order; none without terms.
  std::vector<double> term_energies() const;
  /// Adds the nodal forces of one of them, for output. @throws std::out_of_range if there is no such term
  void add_term_forces(std::size_t term, Eigen::Ref<Eigen::Matrix3Xd> force) const;

  /// What becomes of the power that velocities of the nodes put into the viscous stress at the present
  /// positions, the stress of the last update as in element_fields(). The dashpots' own rates are the stress
  /// by their viscosity, with either StressMeasure. The sum of the three is -(viscous force).velocity over
  /// the nodes. All zero without a viscous law.
  /// @param velocity 3 x n_nodes
  /// @throws std::invalid_argument if `velocity` has another number of columns
  ViscousPower viscous_power(const Eigen::Ref<const Eigen::Matrix3Xd>& velocity) const;

  /// Stretches, stresses and area ratio of every element at the present positions, for output. The viscous
  /// stress is that of the last update (kept in the frame that turns with the element). It checks no element.
  ElementFields element_fields() const;

  /// Everything beyond positions that a restart needs, one flat array: the 3 n_triangles components of the
  /// element normals at the last add_forces(), then, with a viscous law, what ViscousHistory::append_to()
  /// lists.
  std::vector<double> history() const;
  /// @throws std::invalid_argument if the size is wrong, or what a viscous law counts is out of range
  void restore_history(const std::vector<double>& history);

 private:
  friend void advance(std::span<const MembraneStep> steps);
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace tanktread::membrane
