// The XML of a .vti as VTK writes it, for numbers that VTK does not write. Internal to exchange/.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "exchange/array_shape.hpp"
#include "exchange/packet.hpp"

namespace tanktread::exchange {

/// The least and the greatest norm of an array's tuples, as VTK notes them for each array.
using NormRange = std::array<double, 2>;

/// What VTK begins with, and notes of an array without numbers.
inline constexpr NormRange no_norms = {1e299, -1e299};

/// Widens a range by that of some tuples. Those with a NaN are passed over.
void widen(NormRange& range, const ArrayShape& shape, std::span<const double> values);

/// A .vti around the numbers of its point data, of which each array is its length in bytes (64 bits) and its
/// doubles.
class GridText {
 public:
  /// VTK writes a grid without point data, into which these are put.
  /// @param grid all but its point data @param file for messages @throws FileError
  GridText(const GridPacket& grid, const std::vector<ArrayShape>& point_data,
           const std::filesystem::path& file);

  /// What stands before the numbers; as long whatever hash and ranges are.
  /// @param hash values of the array content_hash @param ranges of each array of point data
  std::string before(const std::array<double, 2>& hash, const std::vector<NormRange>& ranges) const;
  /// What stands after them.
  const std::string& after() const { return after_; }

 private:
  std::string head_, field_numbers_, after_;  ///< as VTK wrote them, with a hash of zeros
  std::vector<ArrayShape> point_data_;
  std::uint64_t n_nodes_;
};

}  // namespace tanktread::exchange
