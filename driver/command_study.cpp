#include <fmt/format.h>

#include <map>
#include <memory>
#include <stdexcept>

#include "coupler/coupler.hpp"
#include "driver/case.hpp"
#include "driver/commands.hpp"
#include "driver/study_maxwell.hpp"
#include "driver/study_noise.hpp"
#include "driver/study_twist.hpp"
#include "exchange/vtk_files.hpp"
#include "membrane/maxwell.hpp"

namespace tanktread::driver {
namespace {

/// "what: name, name, ..." of a table of schemes or kernels.
template <class Table>
std::string text_of(const std::string& what, const Table& table) {
  std::string names;
  for (const auto& entry : table) names += (names.empty() ? "" : ", ") + entry.name;
  return what + ": " + names;
}

std::string schemes_text() {
  return text_of("Schemes of the viscous law", membrane::maxwell_schemes());
}

std::string kernel_text() {
  return text_of("Discrete delta", coupler::kernels());
}

/// Writes the table that `make` returns; what the studies refuse is bad input.
template <class Make>
void write_table(const std::string& file, const Make& make) {
  try {
    exchange::write_text(file, make());
  } catch (const std::invalid_argument& error) {
    throw InputError(error.what());
  } catch (const exchange::FileError& error) {
    throw InputError(error.what());
  }
  fmt::print("{}\n", file);
}

void add_file_option(CLI::App& command, std::string& file) {
  command.add_option("--out", file, "Table to write (.csv)")->required();
}

/// Each study once for each of the values, which `set` puts into it.
template <class Study, class Value, class Set>
std::vector<Study> varied(const std::vector<Study>& studies, const std::vector<Value>& values,
                          const Set& set) {
  std::vector<Study> result;
  for (const Study& study : studies) {
    for (const Value& value : values) set(result.emplace_back(study), value);
  }
  return result;
}

struct MaxwellArguments {
  std::vector<std::string> schemes = {"fd", "int1", "int2"};
  std::vector<double> viscosities = {MaxwellStudy().viscosity}, stiffnesses = {1, 10, 100},
                      periods = {MaxwellStudy().period}, time_steps = {MaxwellStudy().time_step};
  std::string file;
};

/// One study for each combination of the lists.
std::vector<MaxwellStudy> studies_of(const MaxwellArguments& arguments) {
  std::vector<MaxwellStudy> studies(1);
  studies = varied(studies, arguments.schemes, [](auto& study, const auto& v) { study.scheme = v; });
  studies = varied(studies, arguments.viscosities, [](auto& study, double v) { study.viscosity = v; });
  studies = varied(studies, arguments.periods, [](auto& study, double v) { study.period = v; });
  studies = varied(studies, arguments.time_steps, [](auto& study, double v) { study.time_step = v; });
  return varied(studies, arguments.stiffnesses, [](auto& study, double v) { study.stiffness = v; });
}

void add_maxwell_command(CLI::App& study, int& exit_code) {
  auto* command = study.add_subcommand(
      "maxwell", "A Maxwell element under the strain 1 - cos(2 pi t/T0), against its exact stress");
  auto arguments = std::make_shared<MaxwellArguments>();
  command->add_option("--scheme", arguments->schemes, schemes_text())->capture_default_str();
  command->add_option("--mu", arguments->viscosities, "Viscosities mu, force times time")
      ->capture_default_str();
  command->add_option("--k", arguments->stiffnesses, "Stiffnesses k' of the spring, force")
      ->capture_default_str();
  command->add_option("--period", arguments->periods, "Periods T0 of the strain, time")
      ->capture_default_str();
  command->add_option("--dt", arguments->time_steps, "Time steps, time; at most T0/2")->capture_default_str();
  add_file_option(*command, arguments->file);
  command->callback([=, &exit_code] {
    write_table(arguments->file, [&] { return maxwell_table(studies_of(*arguments)); });
    exit_code = 0;
  });
}

void add_noise_command(CLI::App& study, int& exit_code) {
  auto* command = study.add_subcommand(
      "strain-rate-noise",
      "The strain rate from interpolated velocities along a streamline of a corner flow");
  auto noise = std::make_shared<NoiseStudy>();
  auto intervals = std::make_shared<std::vector<int>>(std::vector{1, 5, 10, 20, 40});
  auto file = std::make_shared<std::string>();
  command->add_option("--kernel", noise->kernel, kernel_text())->capture_default_str();
  command->add_option("--nodes", noise->nodes, "Grid steps along a side of the unit square")
      ->capture_default_str();
  command->add_option("--dt", noise->time_step, "Time step, times of the flow 3 x^2 y - y^3")
      ->capture_default_str();
  command->add_option("--positions", noise->n_positions, "Positions along the streamline")
      ->capture_default_str();
  command->add_option("--psi", noise->stream_function, "Stream function of the streamline")
      ->capture_default_str();
  command->add_option("--start", noise->start_height, "y of the first position, sides of the square")
      ->capture_default_str();
  command
      ->add_option("--velocity-error", noise->velocity_error,
                   "Relative error that all grid velocities are given")
      ->capture_default_str();
  command->add_option("--interval", *intervals, "Intervals N of the backward difference, steps")
      ->capture_default_str();
  add_file_option(*command, *file);
  command->callback([=, &exit_code] {
    write_table(*file, [&] { return noise_table(*noise, *intervals); });
    exit_code = 0;
  });
}

struct TwistArguments {
  TwistStudy study;
  std::vector<TwistApproach> approaches = {TwistApproach::surface, TwistApproach::flow};
  std::vector<std::string> kernels = {study.kernel};
  std::vector<int> levels = {study.level};
  std::vector<double> radii = {study.radius}, angles = {study.angle_deg};
  std::string file;
};

/// One study for each combination of the lists.
std::vector<TwistStudy> studies_of(const TwistArguments& arguments) {
  std::vector<TwistStudy> studies = {arguments.study};
  studies = varied(studies, arguments.approaches, [](auto& study, auto v) { study.approach = v; });
  studies = varied(studies, arguments.kernels, [](auto& study, const auto& v) { study.kernel = v; });
  studies = varied(studies, arguments.levels, [](auto& study, int v) { study.level = v; });
  studies = varied(studies, arguments.radii, [](auto& study, double v) { study.radius = v; });
  return varied(studies, arguments.angles, [](auto& study, double v) { study.angle_deg = v; });
}

void add_mesh_options(CLI::App& command, TwistArguments& arguments) {
  TwistStudy& study = arguments.study;
  command.add_option("--level", arguments.levels, "Subdivisions of the icosahedron: 20 * 4^level triangles")
      ->check(CLI::Range(0, 8))
      ->capture_default_str();
  command.add_option("--radius", arguments.radii, "Radii R, grid steps")->capture_default_str();
  command.add_option("--axis", study.axis, "Axis x y z about which the mesh is turned at the start")
      ->capture_default_str();
  command.add_option("--angle", arguments.angles, "Angles by which it is turned, degrees")
      ->capture_default_str();
}

void add_motion_options(CLI::App& command, TwistArguments& arguments) {
  TwistStudy& study = arguments.study;
  const std::map<std::string, TwistApproach> approaches = {{"surface", TwistApproach::surface},
                                                           {"flow", TwistApproach::flow}};
  command
      .add_option(
          "--approach", arguments.approaches,
          "surface: nodes moved exactly; flow: by the velocity interpolated from a grid (default: both)")
      ->transform(CLI::CheckedTransformer(approaches));
  command.add_option("--amplitude", study.amplitude, "Amplitude A0 of the twist, radians")
      ->capture_default_str();
  command.add_option("--period", study.period, "Period T0, time steps")->capture_default_str();
  command.add_option("--kernel", arguments.kernels, kernel_text())->capture_default_str();
  command.add_option("--box", study.box, "Grid nodes along each axis, at 1/2, 3/2 ...")
      ->capture_default_str();
  command.add_option("--offset", study.offset, "Centre x y z from the middle of the box, grid steps")
      ->capture_default_str();
  command.add_option("--time", study.times, "When to read the errors, periods")->capture_default_str();
}

void add_law_options(CLI::App& command, TwistArguments& arguments) {
  TwistStudy& study = arguments.study;
  const std::map<std::string, membrane::StressMeasure> measures = {
      {"rate-of-deformation", membrane::StressMeasure::rate_of_deformation},
      {"rate-of-strain", membrane::StressMeasure::rate_of_strain}};
  command.add_option("--scheme", study.schemes, schemes_text())->capture_default_str();
  command
      .add_option("--mu-s", study.viscosity,
                  "Viscosity mu_s of Eq. 3.38 (2 mu_s of the law), force times steps a length")
      ->capture_default_str();
  command.add_option("--k-s", study.stiffness, "Stiffness k_s' of the spring, force a length")
      ->capture_default_str();
  command
      .add_option("--dilatational", study.dilatational_ratio,
                  "Dilatational viscosity over mu_s, at the same relaxation time")
      ->capture_default_str();
  command
      .add_option("--measure", study.measure,
                  "Rate that the dashpots see: rate-of-deformation (default), rate-of-strain")
      ->transform(CLI::CheckedTransformer(measures));
}

void add_twist_command(CLI::App& study, int& exit_code) {
  auto* command = study.add_subcommand(
      "twisting-sphere",
      "A sphere twisted to and fro: strain rate and viscous stress against the exact ones");
  auto arguments = std::make_shared<TwistArguments>();
  add_mesh_options(*command, *arguments);
  add_motion_options(*command, *arguments);
  add_law_options(*command, *arguments);
  add_file_option(*command, arguments->file);
  command->callback([=, &exit_code] {
    write_table(arguments->file, [&] { return twist_table(studies_of(*arguments)); });
    exit_code = 0;
  });
}

}  // namespace

void add_study_command(CLI::App& app, int& exit_code) {
  auto* study = app.add_subcommand("study", "Study a component by itself, without a flow solver");
  study->require_subcommand(1);
  add_maxwell_command(*study, exit_code);
  add_noise_command(*study, exit_code);
  add_twist_command(*study, exit_code);
}

}  // namespace tanktread::driver
