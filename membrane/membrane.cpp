#include "membrane/membrane.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "membrane/implementation.hpp"
#include "membrane/membrane_step.hpp"

namespace tanktread::membrane {

Membrane::Membrane(TriangleMesh reference, std::shared_ptr<const ElasticLaw> law, int threads)
    : Membrane(std::move(reference), std::move(law), nullptr, threads) {}

Membrane::Membrane(TriangleMesh reference, std::shared_ptr<const ElasticLaw> law,
                   std::shared_ptr<const ViscousLaw> viscous, int threads) {
  std::string message;
  for (const auto& defect : defects(inspect(reference))) message += (message.empty() ? "" : "; ") + defect;
  if (!message.empty()) throw std::invalid_argument("membrane mesh: " + message);
  if (!law) throw std::invalid_argument("membrane: an elastic law is needed");
  if (threads < 0) {
    throw std::invalid_argument("membrane: threads = " + std::to_string(threads) +
                                "; 0 (all) or more is needed");
  }
  implementation_ =
      std::make_unique<Implementation>(std::move(reference), std::move(law), std::move(viscous), threads);
}
Membrane::~Membrane() = default;
Membrane::Membrane(Membrane&&) noexcept = default;
Membrane& Membrane::operator=(Membrane&&) noexcept = default;

void Membrane::set_energy_terms(std::unique_ptr<EnergyTerms> terms) {
  if (terms && (terms->n_nodes() != n_nodes() || terms->triangles() != reference().triangles))
    throw std::invalid_argument(
        "membrane: energy terms of other triangles; make them of a mesh with its own");
  implementation_->terms = std::move(terms);
}

int Membrane::n_nodes() const {
  return static_cast<int>(implementation_->positions.cols());
}
int Membrane::n_triangles() const {
  return static_cast<int>(implementation_->reference.triangles.cols());
}
const TriangleMesh& Membrane::reference() const {
  return implementation_->reference;
}
const ElasticLaw& Membrane::elastic_law() const {
  return *implementation_->law;
}
const ViscousLaw* Membrane::viscous_law() const {
  return implementation_->viscous ? &implementation_->viscous->law() : nullptr;
}
const EnergyTerms* Membrane::energy_terms() const {
  return implementation_->terms.get();
}
const Eigen::Matrix3Xd& Membrane::positions() const {
  return implementation_->positions;
}

void Membrane::set_positions(const Eigen::Ref<const Eigen::Matrix3Xd>& positions) {
  implementation_->require_column_per_node("the position array", positions.cols());
  implementation_->positions = positions;
}

void Membrane::begin_at(const Eigen::Ref<const Eigen::Matrix3Xd>& positions) {
  set_positions(positions);
  auto& self = *implementation_;
  // There the strain is zero, not what rounding makes of it.
  const bool is_reference = self.positions == self.reference.points;
  for (Eigen::Index t = 0; t < self.n_elements(); ++t) {
    const Eigen::Matrix3d corners = self.corners(t);
    self.check.normals().col(t) = area_normal(corners);
    if (!self.viscous) continue;
    const SymmetricTensor c =
        is_reference ? unit_tensor : cauchy_green(deformation_gradient(corners, self.elements[t]));
    self.viscous->begin_at(t, 0.5 * (c - unit_tensor));
  }
}

void Membrane::add_forces(Eigen::Ref<Eigen::Matrix3Xd> force) {
  auto& self = *implementation_;
  self.require_column_per_node("the force array", force.cols());
  const MembraneStep step{this, nullptr, &self.node_force};
  advance({&step, 1});
  force += self.node_force;
}

void Membrane::check_elements() {
  const MembraneStep step{this, nullptr, nullptr};
  advance({&step, 1});
}

void Membrane::add_elastic_forces(Eigen::Ref<Eigen::Matrix3Xd> force) const {
  const auto& self = *implementation_;
  self.require_column_per_node("the force array", force.cols());
  Eigen::Matrix3Xd corner_force(3, 3 * n_triangles());
#pragma omp parallel num_threads(self.n_threads)
  {
#pragma omp for schedule(static)
    for (Eigen::Index block = 0; block < self.n_blocks(); ++block)
      self.elastic_corner_forces(block, corner_force);
#pragma omp for schedule(static)
    for (Eigen::Index node = 0; node < force.cols(); ++node)
      force.col(node) += self.corners_of_node.sum(corner_force, node);
  }
}

double Membrane::elastic_energy() const {
  const auto& self = *implementation_;
  Eigen::VectorXd energy(n_triangles());
#pragma omp parallel for num_threads(self.n_threads) schedule(static)
  for (Eigen::Index number = 0; number < self.n_blocks(); ++number) {
    const ElementBlock block = self.evaluated(number);
    for (Eigen::Index k = 0; k < block.size; ++k) {
      const Eigen::Index t = block.begin + k;
      energy[t] = self.elements[t].area * block.response[k].energy;
    }
  }
  double sum = 0;
  for (const double e : energy) sum += e;  // one after the other: no thread count changes the order
  return sum;
}

std::vector<double> Membrane::term_energies() const {
  const auto& self = *implementation_;
  return self.terms ? self.terms->energies(self.positions) : std::vector<double>();
}

void Membrane::add_term_forces(std::size_t term, Eigen::Ref<Eigen::Matrix3Xd> force) const {
  const auto& self = *implementation_;
  self.require_column_per_node("the force array", force.cols());
  if (!self.terms) throw std::out_of_range("membrane: it has no energy terms");
  self.terms->add_forces_of(term, self.positions, force);
}

ViscousPower Membrane::viscous_power(const Eigen::Ref<const Eigen::Matrix3Xd>& velocity) const {
  const auto& self = *implementation_;
  self.require_column_per_node("the velocity array", velocity.cols());
  if (!self.viscous) return {};
  Eigen::Matrix3Xd of_element(3, n_triangles());  // shear, dilatational, all that goes into the stress
#pragma omp parallel for num_threads(self.n_threads) schedule(static)
  for (Eigen::Index t = 0; t < self.n_elements(); ++t) {
    const SurfaceGradient gradient = deformation_gradient(self.corners(t), self.elements[t]);
    const SymmetricTensor c = cauchy_green(gradient);
    const double area = self.elements[t].area * std::sqrt(c.determinant());
    const Eigen::Vector2d dissipated = area * self.viscous->law().dissipation(self.viscous->stress(t));
    const Eigen::Matrix3d forces = corner_forces(gradient, self.viscous_stress(t, c), self.elements[t]);
    const Eigen::Matrix3d velocities = corners_of(velocity, self.reference.triangles.col(t));
    of_element.col(t) << dissipated, -forces.cwiseProduct(velocities).sum();
  }
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (Eigen::Index t = 0; t < of_element.cols(); ++t) sum += of_element.col(t);
  return {sum[0], sum[1], sum[2] - sum[0] - sum[1]};
}

namespace {

void put_tensor(const Eigen::Matrix3d& tensor, Eigen::Ref<Eigen::Matrix<double, 9, 1>> row_by_row) {
  for (int i = 0; i < 9; ++i) row_by_row[i] = tensor(i / 3, i % 3);
}

}  // namespace

ElementFields Membrane::element_fields() const {
  const auto& self = *implementation_;
  ElementFields fields;
  fields.principal_stretches.resize(2, n_triangles());
  fields.stress.resize(9, n_triangles());
  fields.viscous_stress.setZero(9, n_triangles());
  fields.area_ratio.resize(n_triangles());
#pragma omp parallel for num_threads(self.n_threads) schedule(static)
  for (Eigen::Index number = 0; number < self.n_blocks(); ++number) {
    const ElementBlock block = self.evaluated(number);
    for (Eigen::Index k = 0; k < block.size; ++k) {
      const Eigen::Index t = block.begin + k;
      const SymmetricTensor& c = block.cauchy_green[k];
      Eigen::Matrix3d stress = cauchy_stress(block.gradient[k], block.elastic_stress(k));
      if (self.viscous) {
        const Eigen::Matrix3d viscous = cauchy_stress(block.gradient[k], self.viscous_stress(t, c));
        put_tensor(viscous, fields.viscous_stress.col(t));
        stress += viscous;
      }
      put_tensor(stress, fields.stress.col(t));
      fields.principal_stretches.col(t) = principal_stretches(c);
      fields.area_ratio[t] = std::sqrt(c.determinant());
    }
  }
  return fields;
}

std::vector<double> Membrane::history() const {
  const auto& self = *implementation_;
  const auto& normals = self.check.normals();
  std::vector<double> values(normals.data(), normals.data() + normals.size());
  if (self.viscous) self.viscous->append_to(values);
  return values;
}

void Membrane::restore_history(const std::vector<double>& history) {
  auto& self = *implementation_;
  const auto n_normals = static_cast<std::size_t>(self.check.normals().size());
  const std::size_t n_needed = n_normals + (self.viscous ? self.viscous->n_values() : 0);
  if (history.size() != n_needed) {
    throw std::invalid_argument("membrane: a history of " + std::to_string(history.size()) + " numbers, " +
                                std::to_string(n_needed) + " are needed");
  }
  if (self.viscous) self.viscous->restore(std::span(history).subspan(n_normals));
  std::copy_n(history.begin(), n_normals, self.check.normals().data());
}

}  // namespace tanktread::membrane
