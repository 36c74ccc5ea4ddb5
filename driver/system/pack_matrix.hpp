// Matrices in messages between ranks.
#pragma once

#include <Eigen/Core>
#include <span>

#include "ranks/packing.hpp"

namespace tanktread::driver {

/// A matrix of three rows, or as many as its type has, whose columns go with it.
template <class Matrix>
void pack_matrix(ranks::Packing& packing, const Matrix& matrix) {
  packing.put_all(
      std::span<const typename Matrix::Scalar>(matrix.data(), static_cast<std::size_t>(matrix.size())));
}

template <class Matrix>
void take_matrix(ranks::Unpacking& unpacking, Matrix& matrix) {
  const auto numbers = unpacking.take_all<typename Matrix::Scalar>();
  matrix = Eigen::Map<const Matrix>(numbers.data(), Matrix::RowsAtCompileTime,
                                    static_cast<Eigen::Index>(numbers.size()) / Matrix::RowsAtCompileTime);
}

}  // namespace tanktread::driver
