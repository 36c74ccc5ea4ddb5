#include "driver/run/output.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "driver/observe/energy.hpp"
#include "driver/observe/measures.hpp"
#include "driver/units/laws.hpp"
#include "exchange/vtk_files.hpp"

namespace tanktread::driver {
namespace {

/// A table as it was at the point. @param counted of the table, of the counts at the point
TablePoint table_point(const ResumePoint& point, const Schedule& schedule, std::int64_t RowCounts::*counted) {
  TablePoint result{point.step, schedule, {}, point.accept_gaps};
  if (point.counts) result.n_rows = *point.counts.*counted;
  return result;
}

TablePoint observables_point(const ResumePoint& point) {
  return table_point(point, point.schedules.observables, &RowCounts::observables);
}

TablePoint measures_point(const ResumePoint& point) {
  return table_point(point, point.schedules.measures, &RowCounts::measures);
}

TablePoint energy_point(const ResumePoint& point) {
  return table_point(point, point.schedules.energy, &RowCounts::energy);
}

/// Tells of a series what is wrong with it. @throws exchange::FileError if it cannot be made anew
void say_remark(const OutputSeries& series, std::int64_t step, const std::vector<std::int64_t>& kept) {
  const auto remark = series.remark(step, kept);
  if (!remark.empty())
    fmt::print("note: {}; the series is made anew from the files that are there\n", remark);
}

}  // namespace

OutputSchedules output_schedules(const Case& the_case, const FlowParameters& parameters) {
  const auto& every = the_case.output;
  return {schedule_of(every.observables_every, parameters), schedule_of(every.measures_every, parameters),
          schedule_of(every.energy_every, parameters), schedule_of(every.membrane_every, parameters),
          schedule_of(every.fluid_every, parameters)};
}

Output::Output(const Case& the_case, const Parameters& parameters, std::filesystem::path directory)
    : Output(the_case, parameters, std::move(directory), output_schedules(the_case, parameters)) {}

Output::Output(const Case& the_case, const Parameters& parameters, std::filesystem::path directory,
               const OutputSchedules& schedules)
    : case_(the_case),
      shear_rate_(parameters.shear_rate),
      observables_(directory / "observables.csv", observables_header(any_implicit(the_case, parameters)),
                   schedules.observables, OutputTable::Never::header_alone),
      measures_(directory / "measures.csv", measures_header(), schedules.measures,
                OutputTable::Never::no_file),
      energy_(directory / "energy.csv", energy_header(term_names(parameters)), schedules.energy,
              OutputTable::Never::no_file),
      membrane_(directory, "membrane", {"vtu", "pvtu"}, schedules.membrane),
      fluid_(directory, "fluid", {"vti", "pvti"}, schedules.fluid) {}

void Output::begin() {
  observables_.begin();
  measures_.begin();
  energy_.begin();
  membrane_.begin();
  fluid_.begin();
}

void Output::check(const ResumePoint& point) const {
  observables_.check(observables_point(point));
  measures_.check(measures_point(point));
  energy_.check(energy_point(point));
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
  observables_.resume(observables_point(point));
  measures_.resume(measures_point(point));
  energy_.resume(energy_point(point));
  membrane_.cut(membrane, times, shear_rate_);
  fluid_.cut(fluid, times, shear_rate_);
}

bool Output::due(std::int64_t step, bool last) const {
  return observables_.due(step, last) || measures_.due(step, last) || energy_.due(step, last) ||
         membrane_.due(step, last) || fluid_.due(step, last);
}

std::vector<Observation> Output::write(Engine& engine, bool last) {
  const auto step = engine.step();
  const auto write = [&](OutputSeries& series, void (Engine::*write_to)(const std::filesystem::path&)) {
    (engine.*write_to)(series.file(step).replace_extension());
    series.wrote(step);
  };
  const bool has_membrane = membrane_.due(step, last), has_fluid = fluid_.due(step, last);
  if (has_membrane) write(membrane_, &Engine::write_membranes);
  if (has_membrane || has_fluid) membrane_.show(engine.shear_time());
  if (has_fluid) write(fluid_, &Engine::write_flow);
  if (has_membrane || has_fluid) fluid_.show(engine.shear_time());
  if (measures_.due(step, last)) measures_.add(step, engine.measures_rows());
  if (energy_.due(step, last)) energy_.add(step, {energy_row(engine.energy_budget())});
  // This table last: a row of the end of the run says that all is there.
  if (!observables_.due(step, last)) return {};
  const auto observations = engine.observe();
  std::vector<std::string> rows;
  for (const auto& observation : observations) rows.push_back(observables_row(observation));
  observables_.add(step, rows);
  return observations;
}

}  // namespace tanktread::driver
