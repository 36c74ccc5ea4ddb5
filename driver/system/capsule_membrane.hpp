// The membrane of a capsule in a run, whoever computes its forces.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "driver/outside/outside_membrane.hpp"
#include "driver/packets/membrane_state.hpp"
#include "membrane/implicit_viscosity.hpp"
#include "membrane/membrane.hpp"
#include "membrane/membrane_step.hpp"

namespace tanktread::driver {

/// Nodal forces from outside the membrane, which act on it up to a step.
struct NodalLoad {
  Eigen::Matrix3Xd force;  ///< 3 x n_nodes
  std::int64_t end = 0;    ///< the first step at whose positions they are off
};

/// A membrane of the component with its laws, or with a program in their place. The program gives the nodal
/// forces; the kinematics and the check of the elements stay. What the laws would say is then never passed
/// off as a result: it is NaN, unless the program says it.
class CapsuleMembrane {
 public:
  /// @param membrane where it starts
  /// @param program null: none
  /// @param implicit of the triangles of the membrane; null: none
  explicit CapsuleMembrane(membrane::Membrane membrane, std::unique_ptr<OutsideMembrane> program = nullptr,
                           std::unique_ptr<membrane::ImplicitViscosity> implicit = nullptr);

  int n_nodes() const { return membrane_.n_nodes(); }
  int n_triangles() const { return membrane_.n_triangles(); }
  const membrane::TriangleMesh& reference() const { return membrane_.reference(); }
  /// Where its nodes were at the start of the case; those of reference(), unless another shape is free of
  /// stress.
  const Eigen::Matrix3Xd& start() const { return start_; }
  const Eigen::Matrix3Xd& positions() const { return membrane_.positions(); }
  /// @throws std::invalid_argument if the number of columns is not n_nodes()
  void set_positions(const Eigen::Ref<const Eigen::Matrix3Xd>& positions);

  /// The viscosity whose forces the other components take part in; null: none. It stands at the positions of
  /// its last set_positions().
  membrane::ImplicitViscosity* implicit_viscosity() { return implicit_.get(); }
  const membrane::ImplicitViscosity* implicit_viscosity() const { return implicit_.get(); }

  /// The names of the energies beside the law, in the order of their table; none of a program.
  std::vector<std::string> term_names() const;

  bool has_program() const { return program_ != nullptr; }
  /// The time step of the membrane, for membrane::advance(); with a program in the place of its laws that
  /// checks the elements alone. The forces are without those of an implicit viscosity.
  /// @param positions borrowed, as is `force`, which is made as large as it must be
  membrane::MembraneStep step_to(const Eigen::Matrix3Xd& positions, Eigen::Matrix3Xd& force);
  /// The total nodal forces that the program gives at the present positions, 3 x n_nodes.
  /// @param velocity that moved the nodes there
  /// @param step of the positions
  /// @throws RunError if it gives none
  Eigen::Matrix3Xd program_forces(const Eigen::Matrix3Xd& velocity, std::int64_t step);

  /// A load that add_load() adds. @throws std::invalid_argument if it is not of these nodes
  void set_load(NodalLoad load);
  bool has_load() const { return load_.has_value(); }
  /// The nodal forces of the load at the positions of a step, 3 x n_nodes; zero without one.
  Eigen::Matrix3Xd load_at(std::int64_t step) const;
  /// Adds them. @param force 3 x n_nodes
  void add_load(std::int64_t step, Eigen::Matrix3Xd& force) const;

  // For output; of a program the point data elastic_force and the cell data stress, viscous_stress of its
  // last reply, where it has them in the shapes of docs/files.md, else NaN.

  /// Forces of the elastic law, 3 x n_nodes.
  Eigen::Matrix3Xd elastic_forces() const;
  /// Forces of one of the energies beside the law, zero if it has none of that name.
  Eigen::Matrix3Xd term_forces(const std::string& term) const;
  membrane::ElementFields element_fields() const;
  /// Of the elastic law. Of a program always NaN.
  double elastic_energy() const;
  /// Of one of the energies beside the law, 0 if it has none of that name.
  double term_energy(const std::string& term) const;
  /// Of a program always NaN. @param velocity of the nodes at the present positions, 3 x n_nodes
  membrane::ViscousPower viscous_power(const Eigen::Matrix3Xd& velocity) const;

  MembraneState state() const;
  /// @throws std::invalid_argument if it is not of such a membrane
  void restore(const MembraneState& state);

 private:
  membrane::Membrane membrane_;
  Eigen::Matrix3Xd start_;
  std::unique_ptr<OutsideMembrane> program_;
  std::unique_ptr<membrane::ImplicitViscosity> implicit_;
  std::optional<NodalLoad> load_;
};

/// The names of the energies that any of the membranes has beside its law, in the order of their table.
std::vector<std::string> term_names(std::span<const CapsuleMembrane> membranes);

}  // namespace tanktread::driver
