#include "driver/packets/packet_files.hpp"
#include "driver/program/output_file.hpp"
#include "driver/stages/mesh_inputs.hpp"
#include "driver/stages/stage_errors.hpp"
#include "driver/stages/stages.hpp"
#include "driver/stages/state_case.hpp"
#include "driver/system/capsule_shape.hpp"
#include "driver/system/components.hpp"
#include "driver/system/membrane_files.hpp"
#include "driver/system/phases.hpp"
#include "exchange/vtk_files.hpp"

namespace tanktread::driver {
namespace {

/// Takes over the histories of a former output of this stage.
void restore(std::vector<CapsuleMembrane>& membranes, const std::filesystem::path& state) {
  const auto file = exchange::read_surface(state);
  const auto surfaces = surfaces_of(file, state.string());
  check_surfaces(surfaces, membranes, state.string());
  check_references(file, membranes, state.string());
  // An implicit viscosity remembers stresses at these positions.
  for (std::size_t k = 0; k < membranes.size(); ++k) membranes[k].set_positions(surfaces.positions[k]);
  restore_membranes(membranes, file, state.string());
}

/// What the stage begins with: where the nodes are, how fast, and when.
struct Input {
  NodeVectors positions, velocity;
  std::int64_t step = 0;
};

Input read_input(const MembraneStage& stage, const std::vector<CapsuleMembrane>& membranes) {
  const auto name = stage.in.string();
  const auto file = exchange::read_surface(stage.in);
  auto surfaces = surfaces_of(file, name);
  check_surfaces(surfaces, membranes, name);
  check_references(file, membranes, name);
  Input input;
  input.step = step_of(file.field_data, name);
  if (stage.move || exchange::find_optional_array(file.point_data, "velocity") != nullptr) {
    input.velocity = vectors_of(file, "velocity", surfaces, name);
  } else {
    input.velocity = zero_like(surfaces.positions);
  }
  input.positions = std::move(surfaces.positions);
  if (stage.move) {
    input.positions = move_nodes(input.positions, input.velocity);
    ++input.step;
  }
  return input;
}

/// The start of the case: at rest, without forces, and without a step of the membrane.
void write_start(const MembraneStage& stage, const std::vector<CapsuleMembrane>& membranes) {
  const auto zero = zero_like(positions_of(membranes));
  auto file = membrane_file(membranes, zero, zero, 0, 0.0);
  add_state(file, membranes);
  exchange::write_surface(stage.out, file);
}

std::vector<NamedFile> inputs_of(const MembraneStage& stage) {
  std::vector<NamedFile> inputs = {{"--in", stage.in}};  // a state may be carried on in its place
  add_mesh_files(stage.the_case, inputs);
  return inputs;
}

void run(const MembraneStage& stage) {
  check_output({"--out", stage.out}, surface_output(), inputs_of(stage));
  const auto numbers = parameters(stage.the_case);
  auto membranes = make_membranes(stage.the_case, numbers, membrane_shapes(stage.the_case));
  if (!stage.state.empty()) {
    note_other_case(stage.state, stage.the_case, "");
    restore(membranes, stage.state);
  }
  if (stage.in.empty()) {
    write_start(stage, membranes);
    return;
  }
  const auto input = read_input(stage, membranes);
  const auto forces = nodal_forces(membranes, input.positions, input.velocity, input.step);
  auto file = membrane_file(membranes, input.velocity, forces, input.step,
                            static_cast<double>(input.step) * numbers.shear_rate);
  if (any_implicit(membranes)) add_vectors(file, explicit_force_array, forces);
  add_state(file, membranes);
  exchange::write_surface(stage.out, file);
}

}  // namespace

void run_stage(const MembraneStage& stage) {
  with_stage_errors<LongMove, membrane::InvertedElement>([&] { run(stage); });
}

}  // namespace tanktread::driver
