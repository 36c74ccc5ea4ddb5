#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "driver/packets/packet_files.hpp"
#include "driver/program/memory.hpp"
#include "driver/program/output_file.hpp"
#include "driver/stages/mesh_inputs.hpp"
#include "driver/stages/stage_errors.hpp"
#include "driver/stages/stages.hpp"
#include "driver/system/capsule_shape.hpp"
#include "driver/system/components.hpp"
#include "driver/system/implicit_forces.hpp"
#include "driver/system/membrane_files.hpp"
#include "driver/system/phases.hpp"
#include "exchange/vtk_files.hpp"

namespace tanktread::driver {
namespace {

/// The membranes as the membrane stage left them.
std::vector<CapsuleMembrane> membranes_of(const ImplicitStage& stage, const Parameters& numbers,
                                          const exchange::SurfacePacket& file, const Surfaces& surfaces) {
  const auto name = stage.in.string();
  auto membranes = make_membranes(stage.the_case, numbers, membrane_shapes(stage.the_case));
  check_surfaces(surfaces, membranes, name);
  check_references(file, membranes, name);
  for (std::size_t k = 0; k < membranes.size(); ++k) membranes[k].set_positions(surfaces.positions[k]);
  restore_membranes(membranes, file, name);
  return membranes;
}

GridVectors read_free_velocity(const ImplicitStage& stage) {
  const auto name = stage.grid.string();
  auto free = grid_vectors_of(exchange::read_grid(stage.grid), "velocity", stage.the_case.flow.box, name);
  if (free.mobility.empty() && !free.nodes->empty())
    throw InputError(name + ": array 'mobility' is missing; give a file that `tanktread fluid --free` wrote");
  for (std::size_t k = 0; k < free.nodes->size(); ++k) {
    const auto velocity = std::span(free.values).subspan(3 * k, 3);
    const bool finite = std::ranges::all_of(velocity, [](double number) { return std::isfinite(number); });
    if (finite && std::isfinite(free.mobility[k]) && free.mobility[k] > 0) continue;
    throw InputError(
        fmt::format("{}: node {} has the velocity ({}, {}, {}) and the mobility {}; the first must be "
                    "finite, the second positive",
                    name, (*free.nodes)[k], velocity[0], velocity[1], velocity[2], free.mobility[k]));
  }
  return free;
}

/// The forces without implicit viscous ones. A file of a run, or of this stage, has only all forces together.
NodeVectors explicit_forces_of(const exchange::SurfacePacket& file, const Surfaces& surfaces,
                               const std::string& name) {
  if (exchange::find_optional_array(file.point_data, explicit_force_array) == nullptr) {
    throw InputError(
        fmt::format("{}: array '{}' is missing, the forces without implicit viscous ones; give --out of "
                    "`tanktread membrane`",
                    name, explicit_force_array));
  }
  return vectors_of(file, explicit_force_array, surfaces, name);
}

void run(const ImplicitStage& stage) {
  std::vector<NamedFile> inputs = {{"--in", stage.in}, {"--grid", stage.grid}};
  add_mesh_files(stage.the_case, inputs);
  check_output({"--out", stage.out}, surface_output(), inputs);
  const auto& box = stage.the_case.flow.box;
  // Velocity, mobility and the marks of the nodes, and their copy in the file.
  require_memory(2.0 * 5 * sizeof(double) * box[0] * box[1] * box[2],
                 stage.the_case.file.string() + ": flow.box");
  const auto numbers = parameters(stage.the_case);
  const auto file = exchange::read_surface(stage.in);
  const auto surfaces = surfaces_of(file, stage.in.string());
  auto membranes = membranes_of(stage, numbers, file, surfaces);
  if (!any_implicit(membranes)) {
    throw InputError(stage.the_case.file.string() +
                     ": no capsule has an implicit viscosity, so this stage has nothing to do; set "
                     "membrane.viscous.scheme = \"implicit\", or leave the stage out");
  }
  const auto velocity = vectors_of(file, "velocity", surfaces, stage.in.string());
  auto force = explicit_forces_of(file, surfaces, stage.in.string());
  const auto free = read_free_velocity(stage);
  const auto coupler = make_coupler(stage.the_case);
  const auto corrections = make_node_corrections(stage.the_case, *coupler);
  build_stencils(*coupler, corrections, surfaces.positions, surfaces.triangles);
  try {
    add_implicit_forces(membranes, *coupler, corrections, free, implicit_settings(stage.the_case), force);
  } catch (const std::invalid_argument& error) {  // a node that a stencil touches is not in the file
    throw InputError(stage.grid.string() + ": " + error.what());
  }
  const auto step = step_of(file.field_data, stage.in.string());
  auto out = membrane_file(membranes, velocity, force, step, static_cast<double>(step) * numbers.shear_rate);
  add_state(out, membranes);
  exchange::write_surface(stage.out, out);
}

}  // namespace

void run_stage(const ImplicitStage& stage) {
  with_stage_errors<NotConverged, membrane::InvertedElement>([&] {
    try {
      run(stage);
    } catch (const coupler::StencilError& error) {
      throw InputError(stage.in.string() + ": " + error.what());
    } catch (const coupler::CorrectionError& error) {
      throw InputError(stage.in.string() + ": " + error.what());
    }
  });
}

}  // namespace tanktread::driver
