// A series that a run writes: its .pvd, the files that it names, and what stays of both when the run goes on.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "driver/units/schedule.hpp"

namespace tanktread::driver {

/// DIR/NAME.pvd with DIR/NAME/NAME_STEP.EXTENSION; there may be files of several extensions, one a step. What
/// a file is in pieces of lies in the folder DIR/NAME/NAME_STEP. A series has an entry at each time at which
/// this or another series of the run gets a file; where it has none of its own it names its last one again.
/// ParaView shows at a time between two entries what the later one names: without the repetition, a state
/// that is yet to come.
class OutputSeries {
 public:
  /// @param extensions at least one
  OutputSeries(std::filesystem::path directory, std::string name, std::vector<std::string> extensions,
               Schedule schedule);

  /// Whether a file is due: by the schedule, or at the end of a run that writes any.
  bool due(std::int64_t step, bool last) const;

  /// Where the file of a step goes, with the first extension.
  std::filesystem::path file(std::int64_t step) const;

  /// Starts a new series without entries. @throws exchange::FileError
  void begin();

  /// Says that the file of this step is there, later than all before.
  void wrote(std::int64_t step) { last_ = step; }

  /// Adds an entry: what this series shows from this shear time on. Without a file there is nothing to show.
  /// @throws exchange::FileError
  void show(double shear_time) const;

  /// The steps of the files that a run that goes on from `step` keeps, ascending: all before it, as they are,
  /// and that of `step` itself if it is due or was (the last one of a finished run need not be).
  /// @param former the schedule of the run that got there
  std::vector<std::int64_t> steps_kept(std::int64_t step, const Schedule& former) const;

  /// What is wrong with the .pvd, as it is to be told, since cut() makes it anew from the files; "" if
  /// nothing.
  /// @param kept by steps_kept
  /// @throws exchange::FileError if it names what is no file of this series, or its folder is none
  std::string remark(std::int64_t step, const std::vector<std::int64_t>& kept) const;

  /// Writes the .pvd of the files kept, with an entry at each of `times` (steps, ascending), then removes all
  /// later files of this series with their pieces, and those half written. @throws exchange::FileError
  void cut(const std::vector<std::int64_t>& kept, const std::vector<std::int64_t>& times, double shear_rate);

 private:
  std::string relative_file(std::int64_t step, const std::string& extension) const;
  std::string file_there(std::int64_t step) const;
  bool is_left(const std::filesystem::path& path, const std::vector<std::int64_t>& kept) const;
  std::filesystem::path series() const { return directory_ / (name_ + ".pvd"); }
  std::int64_t step_of(const std::string& file_name) const;
  std::vector<std::int64_t> steps_there() const;

  std::filesystem::path directory_;
  std::string name_;
  std::vector<std::string> extensions_;
  Schedule schedule_;
  std::int64_t last_ = no_step;

  static constexpr std::int64_t no_step = -1;
};

}  // namespace tanktread::driver
