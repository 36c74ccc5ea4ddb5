#include <map>
#include <memory>

#include "driver/case/names.hpp"
#include "driver/study/command_study.hpp"
#include "driver/study/study_layers.hpp"

namespace tanktread::driver {
namespace {

struct LayersArguments {
  LayersStudy study;
  std::vector<LayersFlow> flows = {LayersFlow::couette, LayersFlow::channel};
  std::vector<NodeViscosity> forms = {NodeViscosity::sharp, NodeViscosity::harmonic,
                                      NodeViscosity::arithmetic};
  std::vector<std::string> kernels = {study.kernel};
  std::vector<double> ratios = {0.1, 0.2, 5, 10};
  std::vector<int> heights = {8, 16, 32, 64};
  std::string file;
};

/// One study for each combination of the lists.
std::vector<LayersStudy> studies_of(const LayersArguments& arguments) {
  std::vector<LayersStudy> studies = {arguments.study};
  studies = varied(studies, arguments.flows, [](auto& study, auto v) { study.flow = v; });
  studies = varied(studies, arguments.forms, [](auto& study, auto v) { study.form = v; });
  studies = varied(studies, arguments.kernels, [](auto& study, const auto& v) { study.kernel = v; });
  studies = varied(studies, arguments.ratios, [](auto& study, double v) { study.viscosity_ratio = v; });
  return varied(studies, arguments.heights, [](auto& study, int v) { study.height = v; });
}

void add_flow_options(CLI::App& command, LayersArguments& arguments) {
  const std::map<std::string, LayersFlow> flows = {{"couette", LayersFlow::couette},
                                                   {"channel", LayersFlow::channel}};
  command
      .add_option("--flow", arguments.flows,
                  "couette: the upper wall moves; channel: a body force (default: both)")
      ->type_name("TEXT")
      ->transform(CLI::Transformer(flows).description(""))
      ->transform(CLI::IsMember({"couette", "channel"}));  // which looks first, at the word
  const std::map<std::string, NodeViscosity> forms = {{"sharp", NodeViscosity::sharp},
                                                      {"harmonic", NodeViscosity::harmonic},
                                                      {"arithmetic", NodeViscosity::arithmetic}};
  command
      .add_option("--form", arguments.forms,
                  "Viscosity of a node: sharp, by its side; harmonic or arithmetic, the mean by the share of "
                  "its cell below the sheet (default: all)")
      ->type_name("TEXT")
      ->transform(CLI::Transformer(forms).description(""))
      ->transform(CLI::IsMember({"sharp", "harmonic", "arithmetic"}));
  add_number(command, "--lambda", arguments.ratios,
             "Viscosities of the liquid below over that of the one above", positive())
      ->capture_default_str();
}

void add_grid_options(CLI::App& command, LayersArguments& arguments) {
  LayersStudy& study = arguments.study;
  add_number(command, "--height", arguments.heights, "Grid nodes from wall to wall",
             between(1, LayersStudy::most_height))
      ->capture_default_str();
  add_number(command, "--sheet", study.sheet, "Mean height of the sheet over that of the upper wall",
             {.least = 0, .greatest = 1, .least_included = false, .greatest_included = false})
      ->capture_default_str();
  add_number(command, "--places", study.n_places, "Places of the sheet in a grid step about there",
             between(1, LayersStudy::most_places))
      ->capture_default_str();
  command.add_option("--kernel", arguments.kernels, names_text("Discrete delta", kernel_names()))
      ->capture_default_str();
}

void add_solver_options(CLI::App& command, LayersStudy& study) {
  add_number(command, "--relaxation-time", study.relaxation_time, "tau+ of the less viscous liquid",
             {.least = 0.5, .least_included = false})
      ->capture_default_str();
  add_number(command, "--magic", study.magic_parameter, "Magic parameter Lambda of both liquids", positive())
      ->capture_default_str();
  add_number(
      command, "--steadiness", study.steadiness,
      "The flow is steady when velocities change by less than this share of the largest one while what "
      "differs from the steady flow falls by 1/e",
      {.least = LayersStudy::least_steadiness, .greatest = 1, .greatest_included = false})
      ->capture_default_str();
}

}  // namespace

void add_layers_study(CLI::App& study, int& exit_code) {
  auto* command = study.add_subcommand(
      "layers", "Two liquids between walls: the flow, and the velocity of a sheet between them");
  auto arguments = std::make_shared<LayersArguments>();
  add_flow_options(*command, *arguments);
  add_grid_options(*command, *arguments);
  add_solver_options(*command, arguments->study);
  add_file_option(*command, arguments->file);
  command->callback([=, &exit_code] {
    write_table(arguments->file, layers_table({}), [&] { return layers_table(studies_of(*arguments)); });
    exit_code = 0;
  });
}

}  // namespace tanktread::driver
