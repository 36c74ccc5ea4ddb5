#include "driver/run/output.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <charconv>
#include <cstring>
#include <fstream>
#include <set>

#include "driver/packets/fluid_files.hpp"
#include "driver/system/membrane_files.hpp"
#include "exchange/vtk_files.hpp"

namespace tanktread::driver {
namespace {

std::string numbered(const std::string& name, std::int64_t step, const std::string& extension) {
  return fmt::format("{}/{}_{:010}.{}", name, name, step, extension);
}

/// The step in a file's name, membrane_0000012345.vtu.
std::int64_t step_of(const std::string& file, const std::filesystem::path& series) {
  const auto digits = file.substr(file.find_last_of('_') + 1);
  std::int64_t step = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), step);
  if (error != std::errc() || *end != '.') {
    throw exchange::FileError(
        fmt::format("{}: entry {} is not of this run; remove it", series.string(), file));
  }
  return step;
}

/// Keeps the entries of a series that an uninterrupted run would have by `step`, then removes every other
/// file of its folder: those of the entries cut, and what a killed process left there.
void cut_series(const std::filesystem::path& series, std::int64_t step, const Schedule& schedule) {
  std::vector<exchange::SeriesEntry> kept;
  std::set<std::filesystem::path> names;
  for (const auto& entry : exchange::read_series(series)) {
    if (step_of(entry.file, series) > step || !schedule.due(step_of(entry.file, series))) continue;
    kept.push_back(entry);
    names.insert(std::filesystem::path(entry.file).filename());
  }
  exchange::write_series(series, kept);
  std::vector<std::filesystem::path> left;
  for (const auto& file : std::filesystem::directory_iterator(series.parent_path() / series.stem())) {
    if (!names.contains(file.path().filename())) left.push_back(file.path());
  }
  for (const auto& file : left) std::filesystem::remove(file);
}

}  // namespace

Output::Output(const Case& the_case, const Parameters& parameters, std::filesystem::path directory)
    : case_(the_case),
      directory_(std::move(directory)),
      observables_(schedule_of(the_case.output.observables_every, parameters)),
      membrane_(schedule_of(the_case.output.membrane_every, parameters)),
      fluid_(schedule_of(the_case.output.fluid_every, parameters)) {}

void Output::begin() {
  exchange::write_text(directory_ / "observables.csv", observables_header());
  for (const char* name : {"membrane", "fluid"}) {
    std::filesystem::create_directories(directory_ / name);
    exchange::write_series(directory_ / (std::string(name) + ".pvd"), {});
  }
}

void Output::resume(std::int64_t step) {
  truncate_observables(directory_ / "observables.csv", step, observables_);
  cut_series(directory_ / "membrane.pvd", step, membrane_);
  cut_series(directory_ / "fluid.pvd", step, fluid_);
}

std::vector<Observation> Output::write(const System& system, bool last) {
  if (membrane_.due(system.step) || (last && membrane_.interval > 0)) write_membrane(system);
  if (fluid_.due(system.step) || (last && fluid_.interval > 0)) write_fluid(system);
  // The table last: a row of the end of the run says that all is there.
  if (!observables_.due(system.step) && !(last && observables_.interval > 0)) return {};
  const auto observations = observe(system, case_);
  std::ofstream table(directory_ / "observables.csv", std::ios::app);
  for (const auto& observation : observations) table << observables_row(observation);
  if (!table.flush()) {
    throw exchange::FileError(fmt::format("{}: cannot be written: {}",
                                          (directory_ / "observables.csv").string(), std::strerror(errno)));
  }
  return observations;
}

void Output::write_membrane(const System& system) {
  const auto file = numbered("membrane", system.step, "vtu");
  exchange::write_surface(
      directory_ / file, membrane_file(system.membranes, system.node_velocity, system.node_force, system.step,
                                       system.shear_time()));
  exchange::append_to_series(directory_ / "membrane.pvd", {system.shear_time(), file});
}

void Output::write_fluid(const System& system) {
  const auto file = numbered("fluid", system.step, "vti");
  exchange::write_grid(directory_ / file,
                       flow_file(*system.fluid, case_.output.fluid_box, system.step, system.shear_time()));
  exchange::append_to_series(directory_ / "fluid.pvd", {system.shear_time(), file});
}

}  // namespace tanktread::driver
