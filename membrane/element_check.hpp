// Whether the elements of a membrane are still elements: neither collapsed nor turned inside out.
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "membrane/element.hpp"

namespace tanktread::membrane {

/// Compares the normals of all elements with those of the last step. A step takes each element, in any order
/// and from any thread; then, if all are good, accept().
class ElementCheck {
 public:
  explicit ElementCheck(Eigen::Index n_elements) : normals_(3, n_elements), next_normals_(3, n_elements) {}

  /// Takes the corners (as columns) of an element at the new time. False if it has less than a thousandth of
  /// its reference area, its normal has turned by a right angle or more since the last step that was
  /// accepted, or a corner is not finite.
  bool take(Eigen::Index element, const Eigen::Matrix3d& corners, double reference_area) {
    const Eigen::Vector3d normal = area_normal(corners);
    next_normals_.col(element) = normal;
    const double area = 0.5 * normal.norm();  // not finite as soon as one position is not
    return area >= least_area_ratio * reference_area && std::isfinite(area) &&
           normal.dot(normals_.col(element)) > 0;
  }

  /// The normals that were taken become those of the last step.
  void accept() { normals_.swap(next_normals_); }

  /// Twice the area times the normal of each element, a column an element, at the last step.
  const Eigen::Matrix3Xd& normals() const { return normals_; }
  Eigen::Matrix3Xd& normals() { return normals_; }

  /// Says what is wrong with an element for which take() was false. @param nodes its three node numbers
  /// @throws InvertedElement always
  [[noreturn]] void report(Eigen::Index element, const Eigen::Vector3i& nodes, const Eigen::Matrix3d& corners,
                           double reference_area) const;

 private:
  /// An element of less than this share of its reference area has collapsed: it resolves nothing any more,
  /// and the stress of laws that resist a change of area is about to overflow.
  static constexpr double least_area_ratio = 1e-3;

  Eigen::Matrix3Xd normals_, next_normals_;
};

}  // namespace tanktread::membrane
