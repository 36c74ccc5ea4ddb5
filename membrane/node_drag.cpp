#include "membrane/node_drag.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>

#include "membrane/node_areas.hpp"

namespace tanktread::membrane {

NodeDrag::NodeDrag(Eigen::Matrix3Xi triangles, double drag) : triangles_(std::move(triangles)), drag_(drag) {
  if (!(drag > 0 && std::isfinite(drag)))
    throw std::invalid_argument("node drag: the drag must be positive and finite");
}

void NodeDrag::set_positions(const Eigen::Ref<const Eigen::Matrix3Xd>& positions) {
  coefficients_ = drag_ * node_areas(positions, triangles_);
}

Eigen::Matrix3Xd NodeDrag::velocity(const Eigen::Matrix3Xd& force) const {
  return force * coefficients_.cwiseInverse().asDiagonal();
}

NodeDrag::Solution NodeDrag::solve(const Eigen::Matrix3Xd& force, const StrainRates& rates, double tolerance,
                                   int most_iterations, Eigen::Matrix3Xd& velocity) const {
  const auto& drag = coefficients_;
  Eigen::Matrix3Xd strain(3, rates.n_rates()), viscous(3, force.cols());
  const auto product = [&](const Eigen::Matrix3Xd& u) -> Eigen::Matrix3Xd {
    rates.multiply(u, strain);
    rates.multiply_transposed(strain, viscous);
    return u * drag.asDiagonal() + viscous;
  };
  // B^T B takes nothing off: |error of u| is at most |r| in the norm of the inverse of zeta A.
  const auto error_of = [&](double residual) {
    const double size = velocity.cwiseProduct(velocity * drag.asDiagonal()).sum();
    if (residual == 0) return 0.0;
    return size > 0 ? std::sqrt(residual / size) : std::numeric_limits<double>::infinity();
  };
  Eigen::Matrix3Xd residual = force - product(velocity);
  Eigen::Matrix3Xd scaled = this->velocity(residual), direction = scaled;
  double squared = residual.cwiseProduct(scaled).sum();
  Solution solution{0, error_of(squared)};
  while (!(solution.error <= tolerance) && solution.n_iterations < most_iterations) {
    const Eigen::Matrix3Xd image = product(direction);
    const double along = squared / direction.cwiseProduct(image).sum();
    velocity += along * direction;
    residual -= along * image;
    scaled = this->velocity(residual);
    const double before = squared;
    squared = residual.cwiseProduct(scaled).sum();
    direction = scaled + squared / before * direction;
    ++solution.n_iterations;
    solution.error = error_of(squared);
  }
  return solution;
}

}  // namespace tanktread::membrane
