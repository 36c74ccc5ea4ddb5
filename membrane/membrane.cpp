#include "membrane/membrane.hpp"

#include <omp.h>

#include <algorithm>
#include <sstream>

#include "membrane/element.hpp"

namespace tanktread::membrane {
namespace {

/// An element of less than this share of its reference area has collapsed: its shape is no longer resolved,
/// and its strain energy of most laws is about to diverge.
constexpr double least_area_ratio = 1e-3;

/// For every node the element corners that meet in it (3 element + corner), in ascending order: the fixed
/// order in which their forces are summed.
struct CornersOfNode {
  std::vector<int> begin, corner;

  CornersOfNode(const Eigen::Matrix3Xi& triangles, Eigen::Index n_nodes)
      : begin(n_nodes + 1, 0), corner(triangles.size()) {
    for (Eigen::Index k = 0; k < triangles.size(); ++k) ++begin[triangles.data()[k] + 1];
    for (Eigen::Index node = 0; node < n_nodes; ++node) begin[node + 1] += begin[node];
    auto next = begin;
    for (int k = 0; k < triangles.size(); ++k) corner[next[triangles.data()[k]]++] = k;
  }
};

}  // namespace

struct Membrane::Implementation {
  Implementation(TriangleMesh mesh, std::shared_ptr<const ElasticLaw> elastic_law, int threads)
      : n_threads(threads > 0 ? threads : omp_get_max_threads()),
        reference(std::move(mesh)),
        law(std::move(elastic_law)),
        corners_of_node(reference.triangles, reference.points.cols()),
        positions(reference.points),
        corner_force(3, reference.triangles.size()),
        normals(3, reference.triangles.cols()) {
    for (Eigen::Index t = 0; t < reference.triangles.cols(); ++t) {
      elements.push_back(reference_element(corners(t)));
      normals.col(t) = area_normal(corners(t));
    }
  }

  Eigen::Matrix3d corners(Eigen::Index t) const {
    Eigen::Matrix3d result;
    for (int corner = 0; corner < 3; ++corner)
      result.col(corner) = positions.col(reference.triangles(corner, t));
    return result;
  }

  /// Runs over all elements in parallel; `body(t, corners, F, Cg)`.
  template <typename Body>
  void for_each_element(const Body& body) const {
    const Eigen::Index n = reference.triangles.cols();
#pragma omp parallel for num_threads(n_threads) schedule(static)
    for (Eigen::Index t = 0; t < n; ++t) {
      const Eigen::Matrix3d x = corners(t);
      const SurfaceGradient gradient = deformation_gradient(x, elements[t]);
      body(t, x, gradient, cauchy_green(gradient));
    }
  }

  /// Adds the corner forces into the nodes, each node's in the order of its corners.
  void gather(const Eigen::Matrix3Xd& forces, Eigen::Ref<Eigen::Matrix3Xd> target) const {
    const Eigen::Index n = positions.cols();
    if (target.cols() != n)
      throw std::invalid_argument("membrane: the force array needs a column for every node");
#pragma omp parallel for num_threads(n_threads) schedule(static)
    for (Eigen::Index node = 0; node < n; ++node) {
      Eigen::Vector3d sum = target.col(node);
      for (int k = corners_of_node.begin[node]; k < corners_of_node.begin[node + 1]; ++k) {
        sum += forces.col(corners_of_node.corner[k]);
      }
      target.col(node) = sum;
    }
  }

  /// Says what is wrong with an element that has inverted.
  [[noreturn]] void report(Eigen::Index t) const {
    const Eigen::Matrix3d x = corners(t);
    const Eigen::Vector3d centre = x.rowwise().mean();
    const double ratio = 0.5 * area_normal(x).norm() / elements[t].area;
    std::ostringstream message;
    message << "element " << t << " (nodes " << reference.triangles.col(t).transpose() << ") at ("
            << centre.transpose() << ") ";
    if (!x.allFinite()) {
      message << "has a position that is not finite";
    } else if (!(ratio >= least_area_ratio)) {
      message << "has collapsed: its area is " << ratio << " of its reference area, at least "
              << least_area_ratio << " is allowed";
    } else {
      message << "has turned inside out: its normal turned by more than a right angle since the last step";
    }
    throw InvertedElement(message.str());
  }

  /// Checks every element, then takes the present normals as the ones to compare with next time.
  void check_elements() {
    const Eigen::Index n = reference.triangles.cols();
    Eigen::Index first_bad = n;
#pragma omp parallel for num_threads(n_threads) schedule(static) reduction(min : first_bad)
    for (Eigen::Index t = 0; t < n; ++t) {
      const Eigen::Vector3d normal = area_normal(corners(t));
      const bool good =
          0.5 * normal.norm() >= least_area_ratio * elements[t].area && normal.dot(normals.col(t)) > 0;
      if (!good) first_bad = std::min(first_bad, t);
    }
    if (first_bad < n) report(first_bad);
#pragma omp parallel for num_threads(n_threads) schedule(static)
    for (Eigen::Index t = 0; t < n; ++t) normals.col(t) = area_normal(corners(t));
  }

  void elastic_corner_forces(Eigen::Matrix3Xd& forces) const {
    for_each_element([&](Eigen::Index t, const Eigen::Matrix3d&, const SurfaceGradient& gradient,
                         const Eigen::Matrix2d& c) {
      const auto stress = second_piola_kirchhoff(c, law->evaluate(invariants(c)));
      forces.middleCols<3>(3 * t) = corner_forces(gradient, stress, elements[t]);
    });
  }

  int n_threads;
  TriangleMesh reference;
  std::shared_ptr<const ElasticLaw> law;
  CornersOfNode corners_of_node;
  std::vector<ReferenceElement> elements;
  Eigen::Matrix3Xd positions;
  Eigen::Matrix3Xd corner_force;  ///< scratch, a column a corner
  Eigen::Matrix3Xd normals;       ///< twice area times normal at the last add_forces()
};

Membrane::Membrane(TriangleMesh reference, std::shared_ptr<const ElasticLaw> law, int threads) {
  std::string message;
  for (const auto& defect : defects(inspect(reference))) message += (message.empty() ? "" : "; ") + defect;
  if (!message.empty()) throw std::invalid_argument("membrane mesh: " + message);
  if (!law) throw std::invalid_argument("membrane: an elastic law is needed");
  implementation_ = std::make_unique<Implementation>(std::move(reference), std::move(law), threads);
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
const Eigen::Matrix3Xd& Membrane::positions() const {
  return implementation_->positions;
}

void Membrane::set_positions(const Eigen::Ref<const Eigen::Matrix3Xd>& positions) {
  if (positions.cols() != n_nodes())
    throw std::invalid_argument("membrane: positions need a column for every node");
  implementation_->positions = positions;
}

void Membrane::add_forces(Eigen::Ref<Eigen::Matrix3Xd> force) {
  implementation_->check_elements();
  implementation_->elastic_corner_forces(implementation_->corner_force);
  implementation_->gather(implementation_->corner_force, force);
}

void Membrane::add_elastic_forces(Eigen::Ref<Eigen::Matrix3Xd> force) const {
  Eigen::Matrix3Xd forces(3, 3 * n_triangles());
  implementation_->elastic_corner_forces(forces);
  implementation_->gather(forces, force);
}

double Membrane::elastic_energy() const {
  Eigen::VectorXd energy(n_triangles());
  implementation_->for_each_element(
      [&](Eigen::Index t, const Eigen::Matrix3d&, const SurfaceGradient&, const Eigen::Matrix2d& c) {
        energy[t] = implementation_->elements[t].area * implementation_->law->evaluate(invariants(c)).energy;
      });
  double sum = 0;  // in order, so that it does not depend on the vector width either
  for (const double e : energy) sum += e;
  return sum;
}

ElementFields Membrane::element_fields() const {
  ElementFields fields;
  fields.principal_stretches.resize(2, n_triangles());
  fields.stress.resize(9, n_triangles());
  fields.area_ratio.resize(n_triangles());
  implementation_->for_each_element(
      [&](Eigen::Index t, const Eigen::Matrix3d&, const SurfaceGradient& gradient, const Eigen::Matrix2d& c) {
        const double mean = 0.5 * c.trace();
        const double difference = std::hypot(0.5 * (c(0, 0) - c(1, 1)), c(0, 1));
        const double determinant = c.determinant();
        // The smaller square from the product, not from a difference that loses digits.
        fields.principal_stretches.col(t) << std::sqrt(mean + difference),
            std::sqrt(determinant / (mean + difference));
        const auto stress = second_piola_kirchhoff(c, implementation_->law->evaluate(invariants(c)));
        const Eigen::Matrix3d in_space = cauchy_stress(gradient, stress);
        for (int k = 0; k < 9; ++k) fields.stress(k, t) = in_space(k / 3, k % 3);
        fields.area_ratio[t] = std::sqrt(determinant);
      });
  return fields;
}

std::vector<double> Membrane::history() const {
  const auto& normals = implementation_->normals;
  return {normals.data(), normals.data() + normals.size()};
}

void Membrane::restore_history(const std::vector<double>& history) {
  auto& normals = implementation_->normals;
  if (static_cast<Eigen::Index>(history.size()) != normals.size()) {
    throw std::invalid_argument("membrane: a history of " + std::to_string(history.size()) + " numbers, " +
                                std::to_string(normals.size()) + " are needed");
  }
  std::copy(history.begin(), history.end(), normals.data());
}

}  // namespace tanktread::membrane
