#include "membrane/membrane.hpp"

#include <omp.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <string>

#include "membrane/corners_of_node.hpp"
#include "membrane/element.hpp"
#include "membrane/element_check.hpp"
#include "membrane/symmetric_tensor.hpp"
#include "membrane/viscous_history.hpp"

namespace tanktread::membrane {
namespace {

/// Elements go through the law in blocks of this size, whatever the number of threads.
constexpr Eigen::Index block_size = 64;

struct ElementBlock {
  Eigen::Index begin = 0, size = 0;  ///< first element, number of elements
  std::array<SurfaceGradient, block_size> gradient;
  std::array<SymmetricTensor, block_size> cauchy_green;
  std::array<Invariants, block_size> invariants;
  std::array<ElasticResponse, block_size> response;

  SymmetricTensor elastic_stress(Eigen::Index k) const {
    return second_piola_kirchhoff(cauchy_green[k], response[k]);
  }
};

}  // namespace

struct Membrane::Implementation {
  Implementation(TriangleMesh mesh, std::shared_ptr<const ElasticLaw> elastic_law,
                 std::shared_ptr<const ViscousLaw> viscous_law, int threads)
      : n_threads(threads > 0 ? threads : omp_get_max_threads()),
        reference(std::move(mesh)),
        law(std::move(elastic_law)),
        corners_of_node(reference.triangles, reference.points.cols()),
        positions(reference.points),
        corner_force(3, reference.triangles.size()),
        check(reference.triangles.cols()) {
    for (Eigen::Index t = 0; t < n_elements(); ++t) {
      elements.push_back(reference_element(corners(t)));
      check.normals().col(t) = area_normal(corners(t));
    }
    if (viscous_law) viscous.emplace(std::move(viscous_law), n_elements());
  }

  Eigen::Index n_elements() const { return reference.triangles.cols(); }
  Eigen::Index n_blocks() const { return (n_elements() + block_size - 1) / block_size; }

  Eigen::Matrix3d corners(Eigen::Index t) const { return corners_of(positions, reference.triangles.col(t)); }

  /// Strain of the elements of block `number`, and what the law answers to it.
  ElementBlock evaluated(Eigen::Index number) const {
    ElementBlock block;
    block.begin = number * block_size;
    block.size = std::min(block_size, n_elements() - block.begin);
    for (Eigen::Index k = 0; k < block.size; ++k) {
      const Eigen::Index t = block.begin + k;
      block.gradient[k] = deformation_gradient(corners(t), elements[t]);
      block.cauchy_green[k] = cauchy_green(block.gradient[k]);
      block.invariants[k] = invariants(block.cauchy_green[k]);
    }
    const auto size = static_cast<std::size_t>(block.size);
    law->evaluate_all(std::span(block.invariants).first(size), std::span(block.response).first(size));
    return block;
  }

  /// Viscous part of the second Piola-Kirchhoff stress of element `t`, from its history.
  SymmetricTensor viscous_stress(Eigen::Index t, const SymmetricTensor& cauchy_green) const {
    return pulled_back(viscous->stress(t), right_stretch(cauchy_green));
  }

  /// Writes the elastic forces on the corners of the elements of block `number`.
  void elastic_corner_forces(Eigen::Index number, Eigen::Matrix3Xd& forces) const {
    const ElementBlock block = evaluated(number);
    for (Eigen::Index k = 0; k < block.size; ++k) {
      const Eigen::Index t = block.begin + k;
      forces.middleCols<3>(3 * t) = corner_forces(block.gradient[k], block.elastic_stress(k), elements[t]);
    }
  }

  /// The same of the total stress, after the history of the elements has taken their new strain.
  void next_corner_forces(Eigen::Index number, Eigen::Matrix3Xd& forces) {
    if (!viscous) return elastic_corner_forces(number, forces);
    const ElementBlock block = evaluated(number);
    for (Eigen::Index k = 0; k < block.size; ++k) {
      const Eigen::Index t = block.begin + k;
      const SymmetricTensor& c = block.cauchy_green[k];
      viscous->take(t, 0.5 * (c - unit_tensor));
      const SymmetricTensor stress = block.elastic_stress(k) + viscous_stress(t, c);
      forces.middleCols<3>(3 * t) = corner_forces(block.gradient[k], stress, elements[t]);
    }
  }

  /// Shows the elements of block `number` to the check; returns its first bad element, or `none`.
  Eigen::Index first_bad_element(Eigen::Index number, Eigen::Index none) {
    const Eigen::Index begin = number * block_size, end = std::min(begin + block_size, n_elements());
    Eigen::Index bad = none;
    for (Eigen::Index t = begin; t < end; ++t) {
      if (!check.take(t, corners(t), elements[t].area)) bad = std::min(bad, t);
    }
    return bad;
  }

  /// Adds into each node's force what write_corner_forces(block) has written to its corners in
  /// `corner_forces`.
  template <class WriteCornerForces>
  void gather(const WriteCornerForces& write_corner_forces, const Eigen::Matrix3Xd& corner_forces,
              Eigen::Ref<Eigen::Matrix3Xd> force) const {
#pragma omp parallel num_threads(n_threads)
    {
#pragma omp for schedule(static)
      for (Eigen::Index block = 0; block < n_blocks(); ++block) write_corner_forces(block);
#pragma omp for schedule(static)
      for (Eigen::Index node = 0; node < force.cols(); ++node) {
        force.col(node) += corners_of_node.sum(corner_forces, node);
      }
    }
  }

  void require_column_per_node(const std::string& what, Eigen::Index n_columns) const {
    if (n_columns != positions.cols()) {
      throw std::invalid_argument("membrane: " + what + " has " + std::to_string(n_columns) +
                                  " columns, must have one for each of the " +
                                  std::to_string(positions.cols()) + " nodes");
    }
  }

  /// Throws if an element is bad; else their normals are those of the last step from now on.
  void check_elements() {
    const Eigen::Index none = n_elements();
    Eigen::Index bad = none;
#pragma omp parallel for num_threads(n_threads) schedule(static) reduction(min : bad)
    for (Eigen::Index block = 0; block < n_blocks(); ++block) {
      bad = std::min(bad, first_bad_element(block, none));
    }
    if (bad != none) check.report(bad, reference.triangles.col(bad), corners(bad), elements[bad].area);
    check.accept();
  }

  int n_threads;
  TriangleMesh reference;
  std::shared_ptr<const ElasticLaw> law;
  CornersOfNode corners_of_node;
  std::vector<ReferenceElement> elements;
  Eigen::Matrix3Xd positions;
  Eigen::Matrix3Xd corner_force;  ///< scratch, a column a corner
  ElementCheck check;
  std::optional<ViscousHistory> viscous;
};

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
const Eigen::Matrix3Xd& Membrane::positions() const {
  return implementation_->positions;
}

void Membrane::set_positions(const Eigen::Ref<const Eigen::Matrix3Xd>& positions) {
  implementation_->require_column_per_node("the position array", positions.cols());
  implementation_->positions = positions;
}

void Membrane::add_forces(Eigen::Ref<Eigen::Matrix3Xd> force) {
  auto& self = *implementation_;
  self.require_column_per_node("the force array", force.cols());
  self.check_elements();
  if (self.viscous) self.viscous->begin_step();
  self.gather([&](Eigen::Index block) { self.next_corner_forces(block, self.corner_force); },
              self.corner_force, force);
}

void Membrane::check_elements() {
  implementation_->check_elements();
}

void Membrane::add_elastic_forces(Eigen::Ref<Eigen::Matrix3Xd> force) const {
  const auto& self = *implementation_;
  self.require_column_per_node("the force array", force.cols());
  Eigen::Matrix3Xd corner_force(3, 3 * n_triangles());
  self.gather([&](Eigen::Index block) { self.elastic_corner_forces(block, corner_force); }, corner_force,
              force);
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
