#include "driver/run/output.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "driver/packets/fluid_files.hpp"
#include "driver/run/observables_table.hpp"
#include "driver/system/membrane_files.hpp"
#include "driver/units/laws.hpp"
#include "exchange/atomic_file.hpp"
#include "exchange/vtk_files.hpp"

namespace tanktread::driver {
namespace {

/// Whether a row of this step was due up to the point. What only the end of a run wrote, off the schedule, is
/// of the point's own step.
bool was_due(std::int64_t step, const ResumePoint& point) {
  return step < point.step || (step == point.step && point.schedules.observables.due(step));
}

/// A table that is not there may be begun anew.
bool may_be_begun(const std::filesystem::path& table, const ResumePoint& point) {
  if (std::filesystem::exists(table)) return false;
  const bool had_none = point.n_rows ? *point.n_rows == 0 : point.schedules.observables.interval == 0;
  return had_none || point.accept_gaps;
}

/// @throws exchange::FileError if rows are missing
void check_rows(const std::filesystem::path& table, const std::string& header, const ResumePoint& point) {
  if (may_be_begun(table, point)) return;
  auto rows = read_observables(table, header);
  std::erase_if(rows, [&](const TableRow& row) { return !was_due(row.step, point); });
  const auto n_there = static_cast<std::int64_t>(rows.size());
  const auto last = rows.empty() ? -1 : rows.back().step;
  const auto interval = point.schedules.observables.interval;
  const bool is_whole =
      point.n_rows ? n_there >= *point.n_rows : interval == 0 || last >= point.step - point.step % interval;
  if (is_whole || point.accept_gaps) return;
  throw exchange::FileError(
      fmt::format("{}: holds {}{} rows of those up to step {}{}; put the table back as the run wrote it",
                  table.string(), n_there, point.n_rows ? fmt::format(" of {}", *point.n_rows) : "",
                  point.step, last < 0 ? "" : fmt::format(", the last of step {}", last)));
}

/// Cuts a table back to the point. @return how many rows it then has
std::int64_t cut_table(const std::filesystem::path& table, const std::string& header,
                       const ResumePoint& point, const Schedule& now) {
  std::vector<TableRow> rows;
  if (!may_be_begun(table, point)) rows = read_observables(table, header);
  // All before the point stays, whatever the schedule has become: nothing that was asked for is lost.
  std::erase_if(rows, [&](const TableRow& row) {
    return !was_due(row.step, point) && !(row.step == point.step && now.due(row.step));
  });
  write_observables(table, header, rows);
  return static_cast<std::int64_t>(rows.size());
}

/// Tells of a series what is wrong with it. @throws exchange::FileError if it cannot be made anew
void say_remark(const OutputSeries& series, std::int64_t step, const std::vector<std::int64_t>& kept) {
  const auto remark = series.remark(step, kept);
  if (!remark.empty())
    fmt::print("note: {}; the series is made anew from the files that are there\n", remark);
}

}  // namespace

OutputSchedules output_schedules(const Case& the_case, const FlowParameters& parameters) {
  return {schedule_of(the_case.output.observables_every, parameters),
          schedule_of(the_case.output.membrane_every, parameters),
          schedule_of(the_case.output.fluid_every, parameters)};
}

Output::Output(const Case& the_case, const Parameters& parameters, std::filesystem::path directory)
    : case_(the_case),
      directory_(std::move(directory)),
      header_(observables_header(any_implicit(the_case, parameters))),
      shear_rate_(parameters.shear_rate),
      observables_(schedule_of(the_case.output.observables_every, parameters)),
      membrane_(directory_, "membrane", "vtu", schedule_of(the_case.output.membrane_every, parameters)),
      fluid_(directory_, "fluid", "vti", schedule_of(the_case.output.fluid_every, parameters)) {}

void Output::begin() {
  exchange::write_text(directory_ / "observables.csv", header_);
  membrane_.begin();
  fluid_.begin();
}

void Output::check(const ResumePoint& point) const {
  check_rows(directory_ / "observables.csv", header_, point);
  membrane_.remark(point.step, membrane_.steps_kept(point.step, point.schedules.membrane));
  fluid_.remark(point.step, fluid_.steps_kept(point.step, point.schedules.fluid));
}

void Output::resume(const ResumePoint& point) {
  const auto membrane = membrane_.steps_kept(point.step, point.schedules.membrane);
  const auto fluid = fluid_.steps_kept(point.step, point.schedules.fluid);
  say_remark(membrane_, point.step, membrane);
  say_remark(fluid_, point.step, fluid);
  std::vector<std::int64_t> times;
  std::ranges::set_union(membrane, fluid, std::back_inserter(times));
  n_rows_ = cut_table(directory_ / "observables.csv", header_, point, observables_);
  membrane_.cut(membrane, times, shear_rate_);
  fluid_.cut(fluid, times, shear_rate_);
}

std::vector<Observation> Output::write(const System& system, bool last) {
  const bool has_membrane = membrane_.due(system.step, last), has_fluid = fluid_.due(system.step, last);
  if (has_membrane) write_membrane(system);
  if (has_membrane || has_fluid) membrane_.show(system.shear_time());
  if (has_fluid) write_fluid(system);
  if (has_membrane || has_fluid) fluid_.show(system.shear_time());
  // The table last: a row of the end of the run says that all is there.
  if (!observables_.due(system.step) && !(last && observables_.interval > 0)) return {};
  const auto observations = observe(system, case_);
  std::string rows;
  for (const auto& observation : observations) rows += observables_row(observation);
  exchange::append_text(directory_ / "observables.csv", rows);
  if (observables_.due(system.step)) n_rows_ += static_cast<std::int64_t>(observations.size());
  return observations;
}

void Output::write_membrane(const System& system) {
  exchange::write_surface(membrane_.file(system.step),
                          membrane_file(system.membranes, system.node_velocity, system.node_force,
                                        system.step, system.shear_time()));
  membrane_.wrote(system.step);
}

void Output::write_fluid(const System& system) {
  exchange::write_grid(fluid_.file(system.step),
                       flow_file(*system.fluid, case_.output.fluid_box, system.step, system.shear_time(),
                                 system.inside ? system.inside->marks() : std::span<const std::int32_t>()));
  fluid_.wrote(system.step);
}

}  // namespace tanktread::driver
