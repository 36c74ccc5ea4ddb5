// Arrays on the nodes of capsules as spans, the form in which the coupler takes them. All are borrowed.
#pragma once

#include <span>
#include <vector>

#include "driver/packets/packets.hpp"

namespace tanktread::driver {

/// The numbers of a matrix, column after column.
template <class Matrix>
std::span<const typename Matrix::Scalar> numbers_of(const Matrix& matrix) {
  return {matrix.data(), static_cast<std::size_t>(matrix.size())};
}

/// To read from, one span a capsule.
inline std::vector<std::span<const double>> views(const NodeVectors& vectors) {
  std::vector<std::span<const double>> spans;
  for (const auto& matrix : vectors) spans.push_back(numbers_of(matrix));
  return spans;
}

/// To write to, one span a capsule.
inline std::vector<std::span<double>> targets_of(NodeVectors& vectors) {
  std::vector<std::span<double>> spans;
  for (auto& matrix : vectors) spans.emplace_back(matrix.data(), static_cast<std::size_t>(matrix.size()));
  return spans;
}

/// The corners of triangles, one span a capsule.
inline std::vector<std::span<const int>> corners_of(const std::vector<Eigen::Matrix3Xi>& triangles) {
  std::vector<std::span<const int>> spans;
  for (const auto& matrix : triangles) spans.push_back(numbers_of(matrix));
  return spans;
}

}  // namespace tanktread::driver
