// A grid file whose numbers come in parts.
#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <vector>

#include "exchange/array_shape.hpp"
#include "exchange/packet.hpp"

namespace tanktread::exchange {

/// Writes what write_grid() writes, byte for byte, without all numbers in memory at once: each goes to the
/// file when it is added. The file has a temporary name until finish(); if that is not reached the old file
/// stays, and the temporary one goes.
class GridWriter {
 public:
  /// @param grid all but its point data, which are not looked at @param point_data what they will be
  /// @throws FileError as write_grid
  GridWriter(const std::filesystem::path& file, const GridPacket& grid,
             const std::vector<ArrayShape>& point_data);
  ~GridWriter();
  GridWriter(const GridWriter&) = delete;
  GridWriter& operator=(const GridWriter&) = delete;

  /// The next numbers of the point data: array after array, each node after node (x fastest), component
  /// fastest.
  /// @param values of whole nodes of one array @throws FileError if they cannot be written; std::logic_error
  /// for others than are due
  void add(std::span<const double> values);

  /// After all numbers: puts in the hash, brings the file to the disk, and gives it its name.
  /// @throws FileError; std::logic_error if numbers are missing
  void finish();

 private:
  class Work;
  std::unique_ptr<Work> work_;
};

}  // namespace tanktread::exchange
