#include "membrane/strain_rates.hpp"

#include <omp.h>

#include <cmath>
#include <stdexcept>
#include <string>

#include "membrane/element_rates.hpp"
#include "membrane/membrane.hpp"
#include "membrane/tangent_plane.hpp"

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

void require_triangles(const CornersOfNode& corners_of_node, Eigen::Index n_nodes) {
  for (Eigen::Index node = 0; node < n_nodes; ++node) {
    if (!corners_of_node.of(node).empty()) continue;
    throw std::invalid_argument("strain rates: node " + std::to_string(node) +
                                " has no triangle, must have one or more for rates at nodes");
  }
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

[[noreturn]] void throw_without_area(Eigen::Index t, const Eigen::Vector3i& nodes) {
  throw InvertedElement("element " + std::to_string(t) + " (nodes " + std::to_string(nodes[0]) + ", " +
                        std::to_string(nodes[1]) + ", " + std::to_string(nodes[2]) +
                        ") has no area, or a position that is not finite");
}

[[noreturn]] void throw_without_plane(Eigen::Index node, Eigen::Index first_element) {
  throw InvertedElement("node " + std::to_string(node) + " (of element " + std::to_string(first_element) +
                        ") has no tangent plane: the normals of its triangles cancel, or its first edge is "
                        "along their mean");
}

}  // namespace

StrainRates::StrainRates(Eigen::Matrix3Xi triangles, Eigen::Index n_nodes, double shear_viscosity,
                         double dilatational_viscosity, RatesAt at, int threads)
    : at_(at),
      n_threads_(number_of_threads(threads)),
      triangles_(with_nodes_below(n_nodes, std::move(triangles))),
      n_nodes_(n_nodes),
      corners_of_node_(triangles_, n_nodes),
      of_corners_(3, triangles_.size()) {
  const double shear_root = root_of_viscosity("shear_viscosity", shear_viscosity);
  roots_ << shear_root, shear_root, root_of_viscosity("dilatational_viscosity", dilatational_viscosity);
  if (at_ == RatesAt::nodes) require_triangles(corners_of_node_, n_nodes);
}

StrainRates::~StrainRates() = default;
StrainRates::StrainRates(const StrainRates&) = default;
StrainRates& StrainRates::operator=(const StrainRates&) = default;
StrainRates::StrainRates(StrainRates&&) noexcept = default;
StrainRates& StrainRates::operator=(StrainRates&&) noexcept = default;

void StrainRates::set_positions(const Eigen::Ref<const Eigen::Matrix3Xd>& positions) {
  require_columns("the position array", positions.cols(), n_nodes_);
  find_elements(positions, next_surface_);
  if (at_ == RatesAt::nodes) {
    find_planes(positions, next_surface_);
    find_shares(next_surface_);
  }
  std::swap(surface_, next_surface_);
}

void StrainRates::find_elements(const Eigen::Ref<const Eigen::Matrix3Xd>& positions, Surface& surface) const {
  surface.elements.resize(n_elements());
  bool good = true;
#pragma omp parallel for num_threads(n_threads_) schedule(static) reduction(&& : good)
  for (Eigen::Index t = 0; t < n_elements(); ++t) {
    surface.elements[t] = element_rates(edges_of(positions, triangles_.col(t)));
    good = good && surface.elements[t].has_area();
  }
  for (Eigen::Index t = 0; !good && t < n_elements(); ++t)
    if (!surface.elements[t].has_area()) throw_without_area(t, triangles_.col(t));
}

void StrainRates::find_planes(const Eigen::Ref<const Eigen::Matrix3Xd>& positions, Surface& surface) const {
  const auto plane_at = [&](Eigen::Index node) {
    Eigen::Vector3d area_normal = Eigen::Vector3d::Zero();
    double area = 0;
    for (const Eigen::Index corner : corners_of_node_.of(node)) {
      const ElementRates& element = surface.elements[corner / 3];
      area_normal += element.area() * element.normal();
      area += element.area();
    }
    const Eigen::Index first = corners_of_node_.of(node).front();
    const int next = triangles_((first + 1) % 3, first / 3);
    return tangent_plane(area_normal, area, positions.col(next) - positions.col(node));
  };
  surface.planes.resize(n_nodes_);
  bool good = true;
#pragma omp parallel for num_threads(n_threads_) schedule(static) reduction(&& : good)
  for (Eigen::Index node = 0; node < n_nodes_; ++node) {
    surface.planes[node] = plane_at(node);
    good = good && surface.planes[node].exists();
  }
  for (Eigen::Index node = 0; !good && node < n_nodes_; ++node)
    if (!surface.planes[node].exists()) throw_without_plane(node, corners_of_node_.of(node).front() / 3);
}

void StrainRates::find_shares(Surface& surface) const {
  surface.to_node.resize(triangles_.size());
#pragma omp parallel for num_threads(n_threads_) schedule(static)
  for (Eigen::Index t = 0; t < n_elements(); ++t) {
    const ElementRates& element = surface.elements[t];
    for (int corner = 0; corner < 3; ++corner) {
      const TangentPlane& plane = surface.planes[triangles_(corner, t)];
      // sqrt(A_m) (A_t/3)/A_m, of rates that have sqrt(A_t) in them.
      const Eigen::Vector3d factor = element.root_area / (3 * plane.root_area) * roots_;
      surface.to_node[3 * t + corner] = factor.asDiagonal() * rates_projected(element.axes, plane.axes);
    }
  }
}

void StrainRates::require_positions() const {
  if (std::ssize(surface_.elements) != n_elements())
    throw std::logic_error("strain rates: no positions were set");
}

void StrainRates::multiply(const Eigen::Ref<const Eigen::Matrix3Xd>& velocity,
                           Eigen::Ref<Eigen::Matrix3Xd> rates) const {
  require_columns("the velocity array", velocity.cols(), n_nodes_);
  require_columns("the array of rates", rates.cols(), n_rates());
  require_positions();
  const bool at_nodes = at_ == RatesAt::nodes;
#pragma omp parallel num_threads(n_threads_)
  {
#pragma omp for schedule(static)
    for (Eigen::Index t = 0; t < n_elements(); ++t) {
      const Eigen::Vector3d of_element =
          weighted_rates(surface_.elements[t], edges_of(velocity, triangles_.col(t)));
      if (!at_nodes) {
        rates.col(t) = roots_.cwiseProduct(of_element);
        continue;
      }
      for (Eigen::Index k = 3 * t; k < 3 * t + 3; ++k) of_corners_.col(k) = surface_.to_node[k] * of_element;
    }
#pragma omp for schedule(static)
    for (Eigen::Index node = 0; node < (at_nodes ? n_nodes_ : 0); ++node)
      rates.col(node) = corners_of_node_.sum(of_corners_, node);
  }
}

void StrainRates::multiply_transposed(const Eigen::Ref<const Eigen::Matrix3Xd>& rates,
                                      Eigen::Ref<Eigen::Matrix3Xd> force) const {
  require_columns("the array of rates", rates.cols(), n_rates());
  require_columns("the force array", force.cols(), n_nodes_);
  require_positions();
  const auto stress_at = [&](Eigen::Index t) -> Eigen::Vector3d {
    if (at_ == RatesAt::elements) return roots_.cwiseProduct(rates.col(t));
    Eigen::Vector3d stress = Eigen::Vector3d::Zero();
    for (int corner = 0; corner < 3; ++corner)
      stress += surface_.to_node[3 * t + corner].transpose() * rates.col(triangles_(corner, t));
    return stress;
  };
#pragma omp parallel num_threads(n_threads_)
  {
#pragma omp for schedule(static)
    for (Eigen::Index t = 0; t < n_elements(); ++t)
      of_corners_.middleCols<3>(3 * t) = transposed_rates(surface_.elements[t], stress_at(t));
#pragma omp for schedule(static)
    for (Eigen::Index node = 0; node < n_nodes_; ++node)
      force.col(node) = corners_of_node_.sum(of_corners_, node);
  }
}

void StrainRates::carry(Eigen::Ref<Eigen::Matrix3Xd> rates) const {
  require_columns("the array of rates", rates.cols(), n_rates());
  require_positions();
  if (std::ssize(next_surface_.elements) != n_elements())
    throw std::logic_error("strain rates: nothing to carry numbers from: positions were set once");
  const Surface &now = surface_, &before = next_surface_;
  const auto of_node = [&](Eigen::Index node) {
    Eigen::Matrix2d gradient = Eigen::Matrix2d::Zero();
    for (const Eigen::Index corner : corners_of_node_.of(node)) {
      const ElementRates &from = before.elements[corner / 3], &to = now.elements[corner / 3];
      gradient += from.area() * (now.planes[node].axes.transpose() * to.axes) * motion_between(from, to) *
                  (from.axes.transpose() * before.planes[node].axes);
    }
    return gradient;
  };
#pragma omp parallel for num_threads(n_threads_) schedule(static)
  for (Eigen::Index k = 0; k < rates.cols(); ++k) {
    if (at_ == RatesAt::elements) {
      const ElementRates &from = before.elements[k], &to = now.elements[k];
      rates.col(k) = to.root_area / from.root_area * turned(rates.col(k), motion_between(from, to));
    } else {
      rates.col(k) = now.planes[k].root_area / before.planes[k].root_area * turned(rates.col(k), of_node(k));
    }
  }
}

Eigen::Matrix<double, 9, Eigen::Dynamic> StrainRates::stress(
    const Eigen::Ref<const Eigen::Matrix3Xd>& rates) const {
  require_columns("the array of rates", rates.cols(), n_rates());
  require_positions();
  // sqrt(mu) s/sqrt(A) is (tau11 - tau22)/2, tau12, (tau11 + tau22)/2.
  const auto in_space = [&](const auto& place, Eigen::Index k) -> Eigen::Matrix3d {
    return tensor_in_space(place.axes, roots_.cwiseProduct(rates.col(k)) / place.root_area);
  };
  Eigen::Matrix<double, 9, Eigen::Dynamic> result(9, n_elements());
#pragma omp parallel for num_threads(n_threads_) schedule(static)
  for (Eigen::Index t = 0; t < n_elements(); ++t) {
    Eigen::Matrix3d stress;
    if (at_ == RatesAt::elements) {
      stress = in_space(surface_.elements[t], t);
    } else {
      stress.setZero();
      for (const int node : triangles_.col(t)) stress += in_space(surface_.planes[node], node) / 3;
    }
    result.col(t) = stress.reshaped<Eigen::RowMajor>();
  }
  return result;
}

}  // namespace tanktread::membrane
