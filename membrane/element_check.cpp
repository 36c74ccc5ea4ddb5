#include "membrane/element_check.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

#include "membrane/membrane.hpp"

namespace tanktread::membrane {
void ElementCheck::report(Eigen::Index element, const Eigen::Vector3i& nodes, const Eigen::Matrix3d& corners,
                          double reference_area) const {
  const double ratio = 0.5 * area_normal(corners).norm() / reference_area;
  std::ostringstream message;
  const Eigen::IOFormat list(Eigen::StreamPrecision, Eigen::DontAlignCols, ", ");
  message << "membrane element " << element << " (nodes " << nodes.transpose().format(list) << ") at ("
          << corners.rowwise().mean().transpose().format(list) << ") ";
  if (!std::isfinite(ratio)) {
    message << "has a position that is not finite";
  } else if (ratio < least_area_ratio) {
    message << "has collapsed: its area is " << ratio << " of its reference area, at least "
            << least_area_ratio << " is allowed";
  } else {
    const double cosine = area_normal(corners).normalized().dot(normals_.col(element).normalized());
    message << "has turned inside out: its normal turned by "
            << std::acos(std::clamp(cosine, -1.0, 1.0)) * 180.0 / std::numbers::pi
            << " degrees since the last step, less than 90 are allowed";
  }
  message << "; a shorter time step or a finer mesh may help";
  throw InvertedElement(message.str());
}

}  // namespace tanktread::membrane
