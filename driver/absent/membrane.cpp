// A program without the membrane: a case may name any law or scheme.
#include "driver/case/names.hpp"
#include "driver/program/missing_command.hpp"
#include "driver/stages/replay_component.hpp"

namespace tanktread::driver {

void add_membrane_command(CLI::App& app, int&) {
  add_missing_command(app, "membrane", "the membrane");
}

void replay_membrane(ReplayRecord&, const Case&) {
  refuse_missing("tanktread replay --only membrane", "the membrane");
}

void add_mesh_command(CLI::App& app, int&) {
  add_missing_command(app, "mesh", "the membrane");
}

void add_maxwell_study(CLI::App& study, int&) {
  add_missing_command(study, "maxwell", "the membrane");
}

std::vector<std::string> elastic_law_names() {
  return {};
}

std::vector<std::string> elastic_laws_with(const std::string&) {
  return {};
}

std::vector<std::string> maxwell_scheme_names() {
  return {};
}

}  // namespace tanktread::driver
