#include <map>
#include <memory>

#include "driver/case/names.hpp"
#include "driver/case/schema.hpp"
#include "driver/study/command_study.hpp"
#include "driver/study/study_twist.hpp"

namespace tanktread::driver {
namespace {

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
  add_number(command, "--level", arguments.levels, "Subdivisions of the icosahedron: 20 * 4^level triangles",
             find_key("capsule.N.mesh.level")->range)
      ->capture_default_str();
  add_number(command, "--radius", arguments.radii, "Radii R, grid steps", positive())->capture_default_str();
  add_number(command, "--axis", study.axis, "Axis x y z about which the mesh is turned at the start", {})
      ->capture_default_str();
  add_number(command, "--angle", arguments.angles, "Angles by which it is turned, degrees", {})
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
      ->type_name("TEXT")
      ->transform(CLI::Transformer(approaches).description(""))
      ->transform(CLI::IsMember({"surface", "flow"}));  // which looks first, at the word
  add_number(command, "--amplitude", study.amplitude, "Amplitude A0 of the twist, radians", positive())
      ->capture_default_str();
  add_number(command, "--period", study.period, "Period T0, time steps", at_least(4))->capture_default_str();
  command.add_option("--kernel", arguments.kernels, names_text("Discrete delta", kernel_names()))
      ->capture_default_str();
  add_number(command, "--box", study.box, "Grid nodes along each axis, at 1/2, 3/2 ...",
             find_key("flow.box")->range)
      ->capture_default_str();
  add_number(command, "--offset", study.offset, "Centre x y z from the middle of the box, grid steps", {})
      ->capture_default_str();
  add_number(command, "--time", study.times, "When to read the errors, periods", positive())
      ->capture_default_str();
}

void add_law_options(CLI::App& command, TwistArguments& arguments) {
  TwistStudy& study = arguments.study;
  const std::map<std::string, membrane::StressMeasure> measures = {
      {"rate-of-deformation", membrane::StressMeasure::rate_of_deformation},
      {"rate-of-strain", membrane::StressMeasure::rate_of_strain}};
  command
      .add_option("--scheme", study.schemes, names_text("Schemes of the viscous law", maxwell_scheme_names()))
      ->capture_default_str();
  add_number(command, "--mu-s", study.viscosity,
             "Viscosity mu_s of Eq. 3.38 (2 mu_s of the law), force times steps a length", positive())
      ->capture_default_str();
  add_number(command, "--k-s", study.stiffness, "Stiffness k_s' of the spring, force a length", positive())
      ->capture_default_str();
  add_number(command, "--dilatational", study.dilatational_ratio,
             "Dilatational viscosity over mu_s, at the same relaxation time", at_least(0))
      ->capture_default_str();
  command
      .add_option("--measure", study.measure,
                  "Rate that the dashpots see: rate-of-deformation (default), rate-of-strain")
      ->type_name("TEXT")
      ->transform(CLI::Transformer(measures).description(""))
      ->transform(CLI::IsMember({"rate-of-deformation", "rate-of-strain"}));
}

}  // namespace

void add_twist_study(CLI::App& study, int& exit_code) {
  auto* command = study.add_subcommand(
      "twisting-sphere",
      "A sphere twisted to and fro: strain rate and viscous stress against the exact ones");
  auto arguments = std::make_shared<TwistArguments>();
  add_mesh_options(*command, *arguments);
  add_motion_options(*command, *arguments);
  add_law_options(*command, *arguments);
  add_file_option(*command, arguments->file);
  command->callback([=, &exit_code] {
    write_table(arguments->file, twist_table({}), [&] { return twist_table(studies_of(*arguments)); });
    exit_code = 0;
  });
}

}  // namespace tanktread::driver
