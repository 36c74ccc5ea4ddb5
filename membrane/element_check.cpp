#include "membrane/element_check.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

#include "membrane/element.hpp"
#include "membrane/membrane.hpp"

namespace tanktread::membrane {
namespace {

/// An element of less than this share of its reference area has collapsed: it resolves nothing any more, and
/// the stress of laws that resist a change of area is about to overflow.
constexpr double least_area_ratio = 1e-3;

}  // namespace

bool ElementCheck::take(Eigen::Index element, const Eigen::Matrix3d& corners, double reference_area) {
  const Eigen::Vector3d normal = area_normal(corners);
  next_normals_.col(element) = normal;
  const double area = 0.5 * normal.norm();  // not finite as soon as one position is not
  return area >= least_area_ratio * reference_area && std::isfinite(area) &&
         normal.dot(normals_.col(element)) > 0;
}

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
