// A table that a run writes row by row, and what stays of it when the run goes on.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "driver/units/schedule.hpp"

namespace tanktread::driver {

/// What a table was when a state was written from which a run goes on.
struct TablePoint {
  std::int64_t step = 0;
  Schedule schedule;                   ///< of the run that wrote the state
  std::optional<std::int64_t> n_rows;  ///< due up to there; none: not known, told by the schedule
  bool accept_gaps = false;            ///< rows may be missing
};

/// DIR/NAME. Rows are due by a schedule, and at the end of a run that writes any.
class OutputTable {
 public:
  /// Which table there is if its schedule is "never".
  enum class Never { header_alone, no_file };

  /// @param header with its line end
  OutputTable(std::filesystem::path file, std::string header, Schedule schedule, Never never);

  /// Whether rows are due at this step.
  bool due(std::int64_t step, bool last) const;

  /// Starts a new table without rows. @throws exchange::FileError
  void begin();

  /// Adds the rows of a step. @throws exchange::FileError
  void add(std::int64_t step, const std::vector<std::string>& rows);

  /// Whether the run can go on with the table from the point. Writes nothing.
  /// @throws exchange::FileError if it cannot be read or lacks rows
  void check(const TablePoint& point) const;

  /// Cuts the table back to what the run had written up to the point. @throws exchange::FileError
  void resume(const TablePoint& point);

  /// The rows that were due so far.
  std::int64_t n_rows() const { return n_rows_; }

 private:
  bool may_be_begun(const TablePoint& point) const;

  std::filesystem::path file_;
  std::string header_;
  Schedule schedule_;
  Never never_;
  std::int64_t n_rows_ = 0;
};

}  // namespace tanktread::driver
