#include "driver/system/capsule_membrane.hpp"

#include <limits>

namespace tanktread::driver {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// The array of that name with `rows` components, a column a tuple; NaN if there is none.
template <int rows>
Eigen::Matrix<double, rows, Eigen::Dynamic> said(const std::vector<exchange::Array>& arrays, const char* name,
                                                 Eigen::Index columns) {
  using Columns = Eigen::Matrix<double, rows, Eigen::Dynamic>;
  for (const auto& array : arrays) {
    if (array.name == name && array.components == rows)
      return Eigen::Map<const Columns>(array.values.data(), rows, columns);
  }
  return Columns::Constant(rows, columns, unknown);
}

}  // namespace

CapsuleMembrane::CapsuleMembrane(membrane::Membrane membrane, std::unique_ptr<OutsideMembrane> program)
    : membrane_(std::move(membrane)), program_(std::move(program)) {}

membrane::MembraneStep CapsuleMembrane::step_to(const Eigen::Matrix3Xd& positions, Eigen::Matrix3Xd& force) {
  force.resize(3, n_nodes());
  return {&membrane_, &positions, program_ ? nullptr : &force};
}

Eigen::Matrix3Xd CapsuleMembrane::program_forces(const Eigen::Matrix3Xd& velocity, std::int64_t step) {
  return program_->forces(membrane_, velocity, step);
}

Eigen::Matrix3Xd CapsuleMembrane::elastic_forces() const {
  if (program_) return said<3>(program_->state().point_data, "elastic_force", n_nodes());
  Eigen::Matrix3Xd forces = Eigen::Matrix3Xd::Zero(3, n_nodes());
  membrane_.add_elastic_forces(forces);
  return forces;
}

membrane::ElementFields CapsuleMembrane::element_fields() const {
  auto fields = membrane_.element_fields();
  if (program_) {
    const auto& cell_data = program_->state().cell_data;
    fields.stress = said<9>(cell_data, "stress", n_triangles());
    fields.viscous_stress = said<9>(cell_data, "viscous_stress", n_triangles());
  }
  return fields;
}

double CapsuleMembrane::elastic_energy() const {
  return program_ ? unknown : membrane_.elastic_energy();
}

MembraneState CapsuleMembrane::state() const {
  return {membrane_.history(), program_ ? program_->state() : SurfaceArrays()};
}

void CapsuleMembrane::restore(const MembraneState& state) {
  membrane_.restore_history(state.history);
  if (program_) program_->restore(state.program, membrane_);
}

}  // namespace tanktread::driver
