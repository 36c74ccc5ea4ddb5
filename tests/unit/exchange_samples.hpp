// What the tests of exchange share: packets full of awkward numbers, a folder of their own, comparison by
// bits.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "exchange/vtk_files.hpp"

namespace tanktread::exchange::testing {

/// A folder that is there and empty at first, and gone afterwards.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  /// The names of all that is in it, hidden files too, sorted.
  std::vector<std::string> names() const;

 private:
  std::filesystem::path path_;
};

/// The numbers that conversions lose: NaN with payloads (quiet, negative, signalling), infinities, negative
/// zero, subnormals, the largest and the smallest; then 0.1, 1/3 ...
std::vector<double> awkward_numbers();

/// `n` of them, in turn, beginning at the `first`.
std::vector<double> awkward_numbers(std::size_t n, std::size_t first);

/// An octahedron whose points (if `awkward_points`) and data are awkward numbers; the arrays of a membrane
/// file.
SurfacePacket sample_surface(bool awkward_points = true);

/// A grid of 4 x 3 x 2 nodes with the arrays of a checkpoint.
GridPacket sample_grid();

/// "" if every bit is the same, else what differs.
std::string difference(const std::vector<double>& a, const std::vector<double>& b);
std::string difference(const std::vector<Array>& a, const std::vector<Array>& b);
std::string difference(const SurfacePacket& a, const SurfacePacket& b);
std::string difference(const GridPacket& a, const GridPacket& b);

std::string read_text(const std::filesystem::path& file);
/// Without the care of write_text, which waits for the disk each time.
void put_text(const std::filesystem::path& file, const std::string& text);

/// The message of the FileError that `call` throws; "(no error)" if none.
std::string message_of(const std::function<void()>& call);
/// Likewise; fails the test if anything is printed.
std::string error_of(const std::function<void()>& call);

}  // namespace tanktread::exchange::testing
