// A grid file in the form that we give it, of which single numbers are read. Internal to exchange/.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <ctime>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "exchange/descriptor.hpp"
#include "exchange/packet.hpp"

namespace tanktread::exchange {

/// Where a .vti has its numbers, which are doubles as they lie in memory. The file is not held open: a grid
/// may have more pieces than a process can have open files. One that has changed meanwhile is refused.
class RawGridFile {
 public:
  /// Looks at the head as read_piece does. @return none if the file is in another form, for VTK to read
  /// @throws FileError as read_piece
  static std::optional<RawGridFile> open(const std::filesystem::path& file, bool convert);

  /// All but the hash and the values of point data.
  const GridPacket& grid() const { return grid_; }

  /// Reads all numbers, and holds them against the file's hash, if it has one. @throws FileError
  void check_content() const;

  /// The file, opened for one array.
  class Opened {
   public:
    /// @param array one of grid().point_data @throws FileError if the file is gone or has changed
    Opened(const RawGridFile& file, const std::string& array);

    /// Numbers of the array from number `first` on; overwritten. @throws FileError
    void read(std::uint64_t first, std::span<double> values) const;

   private:
    std::filesystem::path name_;
    Descriptor open_;
    std::uint64_t position_ = 0;  ///< of number 0
  };

 private:
  /// Which file it is, and when it was last written to.
  struct Identity {
    dev_t device = 0;
    ino_t number = 0;
    off_t n_bytes = 0;
    std::int64_t seconds = 0, nanoseconds = 0;
    bool operator==(const Identity&) const = default;
  };
  static std::optional<Identity> identity_of(const Descriptor& open);

  std::uint64_t n_values(const Array& shape) const;

  std::filesystem::path name_;
  Identity identity_;
  GridPacket grid_;
  std::optional<Array> hash_;
  std::vector<std::uint64_t> positions_;  ///< of the numbers of each array
};

}  // namespace tanktread::exchange
