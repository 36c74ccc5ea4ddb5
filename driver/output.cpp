#include "driver/output.hpp"

#include <fmt/format.h>

#include <fstream>

#include "exchange/vtk_files.hpp"

namespace tanktread::driver {
namespace {

std::string numbered(const std::string& name, std::int64_t step, const std::string& extension) {
  return fmt::format("{}/{}_{:010}.{}", name, name, step, extension);
}

std::int64_t step_of(const std::string& file) {
  const auto underscore = file.find_last_of('_');
  return std::stoll(file.substr(underscore + 1));
}

/// Adds an entry to a series file, which keeps what it had. The last entry is replaced if it is of the same
/// file.
void add_to_series(const std::filesystem::path& series, double time, const std::string& file) {
  auto entries = exchange::read_series(series);
  if (!entries.empty() && entries.back().file == file) entries.pop_back();
  entries.push_back({time, file});
  exchange::write_series(series, entries);
}

/// Keeps the entries of a series that an uninterrupted run would have by `step`; the files of the others are
/// removed.
void cut_series(const std::filesystem::path& series, std::int64_t step, const Schedule& schedule) {
  std::vector<exchange::SeriesEntry> kept;
  for (const auto& entry : exchange::read_series(series)) {
    if (step_of(entry.file) <= step && schedule.due(step_of(entry.file))) {
      kept.push_back(entry);
    } else {
      std::filesystem::remove(series.parent_path() / entry.file);
    }
  }
  exchange::write_series(series, kept);
}

}  // namespace

Output::Output(const Case& the_case, const Parameters& parameters, std::filesystem::path directory)
    : case_(the_case),
      parameters_(parameters),
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
  const double shear_time = static_cast<double>(system.step) * parameters_.shear_rate;
  std::vector<Observation> observations;
  if (observables_.due(system.step) || (last && observables_.interval > 0)) {
    observations = observe(system, case_, parameters_);
    std::ofstream table(directory_ / "observables.csv", std::ios::app);
    for (const auto& observation : observations) table << observables_row(observation);
    if (!table.flush())
      throw exchange::FileError((directory_ / "observables.csv").string() + ": cannot be written");
  }
  if (membrane_.due(system.step) || (last && membrane_.interval > 0)) write_membrane(system, shear_time);
  if (fluid_.due(system.step) || (last && fluid_.interval > 0)) write_fluid(system, shear_time);
  return observations;
}

void Output::write_membrane(const System& system, double shear_time) {
  const auto file = numbered("membrane", system.step, "vtu");
  exchange::write_surface(directory_ / file, membrane_packet(system, shear_time));
  add_to_series(directory_ / "membrane.pvd", shear_time, file);
}

void Output::write_fluid(const System& system, double shear_time) {
  const auto file = numbered("fluid", system.step, "vti");
  exchange::write_grid(directory_ / file, fluid_packet(system, case_, shear_time));
  add_to_series(directory_ / "fluid.pvd", shear_time, file);
}

}  // namespace tanktread::driver
