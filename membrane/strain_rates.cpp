#include "membrane/strain_rates.hpp"

#include <omp.h>

#include <cmath>
#include <stdexcept>
#include <string>

#include "membrane/membrane.hpp"

namespace tanktread::membrane {
namespace {

int number_of_threads(int threads) {
  if (threads < 0) {
    throw std::invalid_argument("strain rates: threads = " + std::to_string(threads) +
                                "; 0 (all) or more is needed");
  }
  return threads > 0 ? threads : omp_get_max_threads();
}

Eigen::Matrix3Xi with_nodes_below(Eigen::Index n_nodes, Eigen::Matrix3Xi triangles) {
  for (Eigen::Index k = 0; k < triangles.size(); ++k) {
    const int node = triangles.data()[k];
    if (node >= 0 && node < n_nodes) continue;
    throw std::invalid_argument("strain rates: triangle " + std::to_string(k / 3) + " names node " +
                                std::to_string(node) + ", there are " + std::to_string(n_nodes));
  }
  return triangles;
}

double root_of_viscosity(const std::string& name, double viscosity) {
  if (!(std::isfinite(viscosity) && viscosity >= 0)) {
    throw std::invalid_argument("strain rates: " + name + " is " + std::to_string(viscosity) +
                                ", must be 0 or positive");
  }
  return std::sqrt(viscosity);
}

void require_columns(const std::string& what, Eigen::Index n_columns, Eigen::Index n_needed) {
  if (n_columns == n_needed) return;
  throw std::invalid_argument("strain rates: " + what + " has " + std::to_string(n_columns) +
                              " columns, must have " + std::to_string(n_needed));
}

/// Edges from corner 0 to corners 1 and 2, as columns: of nodal velocities, they are exactly zero in a
/// translation.
template <class Points>
SurfaceGradient edges_of(const Points& points, const Eigen::Vector3i& nodes) {
  SurfaceGradient edges;
  edges.col(0) = points.col(nodes[1]) - points.col(nodes[0]);
  edges.col(1) = points.col(nodes[2]) - points.col(nodes[0]);
  return edges;
}

}  // namespace

StrainRates::StrainRates(Eigen::Matrix3Xi triangles, Eigen::Index n_nodes, double shear_viscosity,
                         double dilatational_viscosity, int threads)
    : n_threads_(number_of_threads(threads)),
      triangles_(with_nodes_below(n_nodes, std::move(triangles))),
      n_nodes_(n_nodes),
      shear_root_(root_of_viscosity("shear_viscosity", shear_viscosity)),
      dilatational_root_(root_of_viscosity("dilatational_viscosity", dilatational_viscosity)),
      corners_of_node_(triangles_, n_nodes) {}

StrainRates::Element StrainRates::element_at(const Eigen::Ref<const Eigen::Matrix3Xd>& positions,
                                             Eigen::Index t) const {
  Eigen::Matrix3d corners = Eigen::Matrix3d::Zero();  // seen from corner 0
  corners.rightCols<2>() = edges_of(positions, triangles_.col(t));
  // Its own reference: the deformation gradient is then the axes themselves.
  const ReferenceElement present = reference_element(corners);
  return {deformation_gradient(corners, present), std::sqrt(present.area) * present.shape_gradient};
}

/// A sum |grad N_a|^2 = (sum of the squared edges)/(4 A); it is not a number where a position is none.
bool StrainRates::has_area(const Element& element) {
  return element.weighted_gradient.squaredNorm() < 1e12;
}

void StrainRates::set_positions(const Eigen::Ref<const Eigen::Matrix3Xd>& positions) {
  require_columns("the position array", positions.cols(), n_nodes_);
  next_elements_.resize(n_elements());
  bool good = true;
#pragma omp parallel for num_threads(n_threads_) schedule(static) reduction(&& : good)
  for (Eigen::Index t = 0; t < n_elements(); ++t) {
    next_elements_[t] = element_at(positions, t);
    good = good && has_area(next_elements_[t]);
  }
  for (Eigen::Index t = 0; !good && t < n_elements(); ++t) {
    if (has_area(next_elements_[t])) continue;
    const Eigen::Vector3i nodes = triangles_.col(t);
    throw InvertedElement("element " + std::to_string(t) + " (nodes " + std::to_string(nodes[0]) + ", " +
                          std::to_string(nodes[1]) + ", " + std::to_string(nodes[2]) +
                          ") has no area, or a position that is not finite");
  }
  elements_.swap(next_elements_);
}

void StrainRates::require_positions() const {
  if (std::ssize(elements_) != n_elements()) throw std::logic_error("strain rates: no positions were set");
}

void StrainRates::multiply(const Eigen::Ref<const Eigen::Matrix3Xd>& velocity,
                           Eigen::Ref<Eigen::Matrix3Xd> rates) const {
  require_columns("the velocity array", velocity.cols(), n_nodes_);
  require_columns("the array of rates", rates.cols(), n_elements());
  require_positions();
#pragma omp parallel for num_threads(n_threads_) schedule(static)
  for (Eigen::Index t = 0; t < n_elements(); ++t) {
    const Element& element = elements_[t];
    // sqrt(A) grad u in the plane of the element.
    const SurfaceGradient in_space =
        edges_of(velocity, triangles_.col(t)) * element.weighted_gradient.bottomRows<2>();
    const Eigen::Matrix2d gradient = element.axes.transpose() * in_space;
    rates.col(t) << shear_root_ * (gradient(0, 0) - gradient(1, 1)),
        shear_root_ * (gradient(0, 1) + gradient(1, 0)),
        dilatational_root_ * (gradient(0, 0) + gradient(1, 1));
  }
}

void StrainRates::multiply_transposed(const Eigen::Ref<const Eigen::Matrix3Xd>& rates,
                                      Eigen::Ref<Eigen::Matrix3Xd> force) const {
  require_columns("the array of rates", rates.cols(), n_elements());
  require_columns("the force array", force.cols(), n_nodes_);
  require_positions();
  const auto of_corner = [&](Eigen::Index corner) -> Eigen::Vector3d {
    const Eigen::Index t = corner / 3;
    const double difference = shear_root_ * rates(0, t), shear = shear_root_ * rates(1, t),
                 mean = dilatational_root_ * rates(2, t);
    // The stress tau_v times sqrt(A), and its force A tau_v grad N_a.
    const Eigen::Vector2d gradient = elements_[t].weighted_gradient.row(corner % 3).transpose();
    const Eigen::Vector2d in_plane((mean + difference) * gradient[0] + shear * gradient[1],
                                   shear * gradient[0] + (mean - difference) * gradient[1]);
    return elements_[t].axes * in_plane;
  };
#pragma omp parallel for num_threads(n_threads_) schedule(static)
  for (Eigen::Index node = 0; node < n_nodes_; ++node)
    force.col(node) = corners_of_node_.sum_of(node, of_corner);
}

}  // namespace tanktread::membrane
