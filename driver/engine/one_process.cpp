#include "driver/engine/one_process.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "coupler/tangential_correction.hpp"
#include "driver/observe/measures.hpp"
#include "driver/program/errors.hpp"
#include "driver/system/capsule_shape.hpp"
#include "driver/system/fluid_output.hpp"
#include "driver/system/state_folder.hpp"
#include "driver/system/step.hpp"

namespace tanktread::driver {

OneProcess::OneProcess(const Case& the_case, const Parameters& parameters)
    : case_(the_case), parameters_(parameters) {}

void OneProcess::begin(const MembraneShapes& shapes) {
  const bool are_made = !shapes.meshes.empty();
  system_ = make_system(case_, parameters_, are_made ? shapes : membrane_shapes(case_));
}

void OneProcess::restore(const SavedState& state) {
  try {
    system_ = make_system(case_, parameters_, state.shapes);
  } catch (const std::invalid_argument& error) {  // of a shape that is no membrane's
    throw InputError(fmt::format("{}: does not fit the case: {}", state.folder.string(), error.what()));
  }
  driver::restore(system_, state);
}

void OneProcess::advance() {
  driver::advance(system_, *passage_);
}

std::vector<Observation> OneProcess::observe() {
  return driver::observe(system_, case_);
}

std::vector<std::string> OneProcess::measures_rows() {
  std::vector<std::string> rows;
  for (const auto& row : measure(system_, case_)) rows.push_back(measures_row(row));
  return rows;
}

EnergyBudget OneProcess::energy_budget() {
  try {
    return driver::energy_budget(system_, case_);
  } catch (const coupler::CorrectionError& error) {
    throw RunError(fmt::format("step {}: {}", system_.step, error.what()));
  }
}

void OneProcess::write_membranes(const std::filesystem::path& file) {
  write_surfaces({file, false, most_triangles(case_, FileSizes::by_case)}, capsules_now(system_));
}

void OneProcess::write_flow(const std::filesystem::path& file) {
  driver::write_flow(system_, case_, file);
}

void OneProcess::write_state(const std::filesystem::path& folder) {
  driver::write_state(folder, system_, case_, FileSizes::by_case);
}

}  // namespace tanktread::driver
