#include "driver/run/output.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "driver/packets/fluid_files.hpp"
#include "driver/system/membrane_files.hpp"
#include "exchange/atomic_file.hpp"
#include "exchange/vtk_files.hpp"

namespace tanktread::driver {
namespace {

/// Tells of a series what is wrong with it. @throws exchange::FileError if it cannot be made anew
void say_remark(const OutputSeries& series, std::int64_t step, const std::vector<std::int64_t>& kept) {
  const auto remark = series.remark(step, kept);
  if (!remark.empty())
    fmt::print("note: {}; the series is made anew from the files that are there\n", remark);
}

}  // namespace

Output::Output(const Case& the_case, const Parameters& parameters, std::filesystem::path directory)
    : case_(the_case),
      directory_(std::move(directory)),
      shear_rate_(parameters.shear_rate),
      observables_(schedule_of(the_case.output.observables_every, parameters)),
      membrane_(directory_, "membrane", "vtu", schedule_of(the_case.output.membrane_every, parameters)),
      fluid_(directory_, "fluid", "vti", schedule_of(the_case.output.fluid_every, parameters)) {}

void Output::begin() {
  exchange::write_text(directory_ / "observables.csv", observables_header());
  membrane_.begin();
  fluid_.begin();
}

void Output::resume(std::int64_t step) {
  const auto membrane = membrane_.steps_kept(step), fluid = fluid_.steps_kept(step);
  say_remark(membrane_, step, membrane);
  say_remark(fluid_, step, fluid);
  std::vector<std::int64_t> times;
  std::ranges::set_union(membrane, fluid, std::back_inserter(times));
  truncate_observables(directory_ / "observables.csv", step, observables_);
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
                       flow_file(*system.fluid, case_.output.fluid_box, system.step, system.shear_time()));
  fluid_.wrote(system.step);
}

}  // namespace tanktread::driver
