// A symmetric tensor in the plane of an element, as three plain numbers.
#pragma once

#include <Eigen/Core>

namespace tanktread::membrane {

/// What strains and stresses of an element are. As numbers they stay in registers through the loop over
/// elements, where 2 x 2 matrices are written to memory and read again.
struct SymmetricTensor {
  double xx = 0, xy = 0, yy = 0;

  /// @param tensor symmetric: its lower left component is not looked at
  static SymmetricTensor of(const Eigen::Matrix2d& tensor) {
    return {tensor(0, 0), tensor(0, 1), tensor(1, 1)};
  }
  Eigen::Matrix2d matrix() const { return (Eigen::Matrix2d() << xx, xy, xy, yy).finished(); }

  double trace() const { return xx + yy; }
  double determinant() const { return xx * yy - xy * xy; }

  friend SymmetricTensor operator+(const SymmetricTensor& a, const SymmetricTensor& b) {
    return {a.xx + b.xx, a.xy + b.xy, a.yy + b.yy};
  }
  friend SymmetricTensor operator-(const SymmetricTensor& a, const SymmetricTensor& b) {
    return {a.xx - b.xx, a.xy - b.xy, a.yy - b.yy};
  }
  friend SymmetricTensor operator*(double factor, const SymmetricTensor& a) {
    return {factor * a.xx, factor * a.xy, factor * a.yy};
  }
};

/// The unit tensor.
inline constexpr SymmetricTensor unit_tensor = {1, 0, 1};

/// V A V, which is symmetric as both are.
inline SymmetricTensor on_both_sides(const SymmetricTensor& v, const SymmetricTensor& a) {
  // The rows of V A.
  const double first_x = v.xx * a.xx + v.xy * a.xy, first_y = v.xx * a.xy + v.xy * a.yy;
  const double second_x = v.xy * a.xx + v.yy * a.xy, second_y = v.xy * a.xy + v.yy * a.yy;
  return {first_x * v.xx + first_y * v.xy, first_x * v.xy + first_y * v.yy,
          second_x * v.xy + second_y * v.yy};
}

}  // namespace tanktread::membrane
