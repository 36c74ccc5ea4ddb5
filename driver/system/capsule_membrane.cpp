#include "driver/system/capsule_membrane.hpp"

#include <algorithm>
#include <limits>
#include <span>
#include <stdexcept>

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

CapsuleMembrane::CapsuleMembrane(membrane::Membrane membrane, std::unique_ptr<OutsideMembrane> program,
                                 std::unique_ptr<membrane::ImplicitViscosity> implicit)
    : membrane_(std::move(membrane)),
      start_(membrane_.positions()),
      program_(std::move(program)),
      implicit_(std::move(implicit)) {
  if (implicit_) implicit_->set_positions(membrane_.positions());
}

void CapsuleMembrane::set_positions(const Eigen::Ref<const Eigen::Matrix3Xd>& positions) {
  membrane_.set_positions(positions);
  if (implicit_) implicit_->set_positions(positions);
}

membrane::MembraneStep CapsuleMembrane::step_to(const Eigen::Matrix3Xd& positions, Eigen::Matrix3Xd& force) {
  force.resize(3, n_nodes());
  return {&membrane_, &positions, program_ ? nullptr : &force};
}

Eigen::Matrix3Xd CapsuleMembrane::program_forces(const Eigen::Matrix3Xd& velocity, std::int64_t step) {
  return program_->forces(membrane_, velocity, step);
}

void CapsuleMembrane::set_load(NodalLoad load) {
  if (load.force.cols() != n_nodes())
    throw std::invalid_argument("a load must have a force for each node of its membrane");
  load_ = std::move(load);
}

Eigen::Matrix3Xd CapsuleMembrane::load_at(std::int64_t step) const {
  if (!load_ || step >= load_->end) return Eigen::Matrix3Xd::Zero(3, n_nodes());
  return load_->force;
}

void CapsuleMembrane::add_load(std::int64_t step, Eigen::Matrix3Xd& force) const {
  if (load_ && step < load_->end) force += load_->force;
}

Eigen::Matrix3Xd CapsuleMembrane::elastic_forces() const {
  if (program_) return said<3>(program_->state().point_data, "elastic_force", n_nodes());
  Eigen::Matrix3Xd forces = Eigen::Matrix3Xd::Zero(3, n_nodes());
  membrane_.add_elastic_forces(forces);
  return forces;
}

std::vector<std::string> CapsuleMembrane::term_names() const {
  std::vector<std::string> names;
  const auto* terms = membrane_.energy_terms();
  for (std::size_t k = 0; terms != nullptr && k < terms->size(); ++k) names.push_back(terms->name(k));
  return names;
}

Eigen::Matrix3Xd CapsuleMembrane::term_forces(const std::string& term) const {
  Eigen::Matrix3Xd forces = Eigen::Matrix3Xd::Zero(3, n_nodes());
  const auto names = term_names();
  const auto found = std::ranges::find(names, term);
  if (found != names.end())
    membrane_.add_term_forces(static_cast<std::size_t>(found - names.begin()), forces);
  return forces;
}

membrane::ElementFields CapsuleMembrane::element_fields() const {
  auto fields = membrane_.element_fields();
  if (program_) {
    const auto& cell_data = program_->state().cell_data;
    fields.stress = said<9>(cell_data, "stress", n_triangles());
    fields.viscous_stress = said<9>(cell_data, "viscous_stress", n_triangles());
  } else if (implicit_) {
    fields.viscous_stress = implicit_->rates().stress(implicit_->stress());
    fields.stress += fields.viscous_stress;
  }
  return fields;
}

double CapsuleMembrane::elastic_energy() const {
  return program_ ? unknown : membrane_.elastic_energy();
}

double CapsuleMembrane::term_energy(const std::string& term) const {
  const auto names = term_names();
  const auto found = std::ranges::find(names, term);
  return found == names.end() ? 0
                              : membrane_.term_energies()[static_cast<std::size_t>(found - names.begin())];
}

membrane::ViscousPower CapsuleMembrane::viscous_power(const Eigen::Matrix3Xd& velocity) const {
  if (program_) return {unknown, unknown, unknown};
  return implicit_ ? implicit_->power(velocity) : membrane_.viscous_power(velocity);
}

MembraneState CapsuleMembrane::state() const {
  MembraneState state{membrane_.history(), program_ ? program_->state() : SurfaceArrays()};
  if (implicit_) implicit_->append_to(state.history);
  return state;
}

void CapsuleMembrane::restore(const MembraneState& state) {
  if (implicit_) {
    // Both parts are checked before one of them is taken.
    const auto& history = state.history;
    const auto n_elastic = history.size() - std::min(history.size(), implicit_->n_values());
    membrane_.restore_history({history.begin(), history.begin() + static_cast<std::ptrdiff_t>(n_elastic)});
    implicit_->restore(std::span(history).subspan(n_elastic));
  } else {
    membrane_.restore_history(state.history);
  }
  if (program_) program_->restore(state.program, membrane_);
}

std::vector<std::string> term_names(std::span<const CapsuleMembrane> membranes) {
  std::vector<std::string> names;
  for (const auto& entry : membrane::energy_term_table()) {
    const auto has = [&](const CapsuleMembrane& membrane) {
      const auto own = membrane.term_names();
      return std::ranges::find(own, entry.name) != own.end();
    };
    if (std::ranges::any_of(membranes, has)) names.push_back(entry.name);
  }
  return names;
}

}  // namespace tanktread::driver
