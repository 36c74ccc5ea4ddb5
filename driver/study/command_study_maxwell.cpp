#include <memory>

#include "driver/case/names.hpp"
#include "driver/study/command_study.hpp"
#include "driver/study/study_maxwell.hpp"

namespace tanktread::driver {
namespace {

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

}  // namespace

void add_maxwell_study(CLI::App& study, int& exit_code) {
  auto* command = study.add_subcommand(
      "maxwell", "A Maxwell element under the strain 1 - cos(2 pi t/T0), against its exact stress");
  auto arguments = std::make_shared<MaxwellArguments>();
  command
      ->add_option("--scheme", arguments->schemes,
                   names_text("Schemes of the viscous law", maxwell_scheme_names()))
      ->capture_default_str();
  add_number(*command, "--mu", arguments->viscosities, "Viscosities mu, force times time", positive())
      ->capture_default_str();
  add_number(*command, "--k", arguments->stiffnesses, "Stiffnesses k' of the spring, force", positive())
      ->capture_default_str();
  add_number(*command, "--period", arguments->periods, "Periods T0 of the strain, time", positive())
      ->capture_default_str();
  add_number(*command, "--dt", arguments->time_steps, "Time steps, time; at most T0/2", positive())
      ->capture_default_str();
  add_file_option(*command, arguments->file);
  command->callback([=, &exit_code] {
    write_table(arguments->file, maxwell_table({}), [&] { return maxwell_table(studies_of(*arguments)); });
    exit_code = 0;
  });
}

}  // namespace tanktread::driver
