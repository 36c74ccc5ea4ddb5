// A record of steps, read packet by packet, and the comparison with what a component gives now.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "driver/packets/packet_files.hpp"
#include "driver/packets/saved_state.hpp"
#include "driver/stages/replay.hpp"

namespace tanktread::driver {

/// The directory of `tanktread run --record`, and the differences found so far.
class ReplayRecord {
 public:
  /// @throws InputError if it is no complete record
  explicit ReplayRecord(const ReplayOptions& options);

  const SavedState& begin() const { return begin_; }
  std::int64_t first_step() const { return begin_.step + 1; }
  std::int64_t last_step() const { return last_step_; }
  /// Whether it has the packets of implicit viscosities.
  bool has_implicit() const;

  /// The positions that the step which makes `step` begins with.
  NodeVectors positions_before(std::int64_t step) const;
  /// The surfaces there, and the total force at them.
  Surfaces surfaces_before(std::int64_t step) const;
  NodeVectors force_before(std::int64_t step) const;
  /// A packet of the step that makes `step`.
  NodeVectors nodes(Packet packet, std::int64_t step) const;
  /// @param everywhere all nodes of the file, not only those that crossed the border
  GridVectors grid(Packet packet, std::int64_t step, bool everywhere = false) const;

  /// The nodes that the step which makes `step` brought into a capsule, or out of one.
  /// @param everywhere the marks of all nodes instead
  GridMarks marks(std::int64_t step, bool everywhere = false) const;
  /// Whether the fluid in a capsule has another viscosity, and the record such marks.
  bool has_marks() const;

  /// Compares a packet with the recorded one; writes the difference as a field if that is wanted.
  void compare(Packet packet, std::int64_t step, const NodeVectors& given);
  void compare(Packet packet, std::int64_t step, const GridVectors& given);
  /// @param all the marks of all nodes after that
  void compare(std::int64_t step, const GridMarks& news, std::span<const std::int32_t> all);
  /// Compares arrays of the state at the end: those that `given` has too.
  void compare_end(const exchange::SurfacePacket& given);
  void compare_end(const exchange::GridPacket& given);

  const std::vector<ReplayedArray>& differences() const { return differences_; }

 private:
  template <class File>
  void add(std::int64_t step, const std::string& packet, const std::filesystem::path& file,
           const File& recorded, const File& given);
  template <class File>
  void write_field(Packet packet, std::int64_t step, File recorded, const File& given,
                   const std::string& array);

  std::filesystem::path directory_, out_;
  Box box_ = {0, 0, 0};
  SavedState begin_;
  bool has_end_ = false;
  std::int64_t last_step_ = 0;
  std::vector<ReplayedArray> differences_;
};

}  // namespace tanktread::driver
