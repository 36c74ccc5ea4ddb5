#include "driver/run/output_table.hpp"

#include <fmt/format.h>

#include <utility>

#include "driver/run/table_file.hpp"
#include "exchange/atomic_file.hpp"
#include "exchange/vtk_files.hpp"

namespace tanktread::driver {
namespace {

/// Whether a row of this step was due up to the point. What only the end of a run wrote, off the schedule, is
/// of the point's own step.
bool was_due(std::int64_t step, const TablePoint& point) {
  return step < point.step || (step == point.step && point.schedule.due(step));
}

}  // namespace

OutputTable::OutputTable(std::filesystem::path file, std::string header, Schedule schedule, Never never)
    : file_(std::move(file)), header_(std::move(header)), schedule_(schedule), never_(never) {}

bool OutputTable::due(std::int64_t step, bool last) const {
  return schedule_.due(step) || (last && schedule_.interval > 0);
}

void OutputTable::begin() {
  if (schedule_.interval > 0 || never_ == Never::header_alone) exchange::write_text(file_, header_);
}

void OutputTable::add(std::int64_t step, const std::vector<std::string>& rows) {
  std::string text;
  for (const auto& row : rows) text += row;
  exchange::append_text(file_, text);
  if (schedule_.due(step)) n_rows_ += static_cast<std::int64_t>(rows.size());
}

/// A table that is not there may be begun anew.
bool OutputTable::may_be_begun(const TablePoint& point) const {
  if (std::filesystem::exists(file_)) return false;
  const bool had_none = point.n_rows ? *point.n_rows == 0 : point.schedule.interval == 0;
  return had_none || point.accept_gaps;
}

void OutputTable::check(const TablePoint& point) const {
  if (may_be_begun(point)) return;
  auto rows = read_table(file_, header_);
  std::erase_if(rows, [&](const TableRow& row) { return !was_due(row.step, point); });
  const auto n_there = static_cast<std::int64_t>(rows.size());
  const auto last = rows.empty() ? -1 : rows.back().step;
  const auto interval = point.schedule.interval;
  const bool is_whole =
      point.n_rows ? n_there >= *point.n_rows : interval == 0 || last >= point.step - point.step % interval;
  if (is_whole || point.accept_gaps) return;
  throw exchange::FileError(
      fmt::format("{}: holds {}{} rows of those up to step {}{}; put the table back as the run wrote it",
                  file_.string(), n_there, point.n_rows ? fmt::format(" of {}", *point.n_rows) : "",
                  point.step, last < 0 ? "" : fmt::format(", the last of step {}", last)));
}

void OutputTable::resume(const TablePoint& point) {
  if (may_be_begun(point)) return begin();
  auto rows = read_table(file_, header_);
  // All before the point stays, whatever the schedule has become: nothing that was asked for is lost.
  std::erase_if(rows, [&](const TableRow& row) {
    return !was_due(row.step, point) && !(row.step == point.step && schedule_.due(row.step));
  });
  write_table(file_, header_, rows);
  n_rows_ = static_cast<std::int64_t>(rows.size());
}

}  // namespace tanktread::driver
