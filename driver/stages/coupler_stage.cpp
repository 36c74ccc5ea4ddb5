#include <fmt/format.h>

#include <algorithm>

#include "driver/packets/packet_files.hpp"
#include "driver/program/memory.hpp"
#include "driver/program/output_file.hpp"
#include "driver/stages/stage_errors.hpp"
#include "driver/stages/stages.hpp"
#include "driver/system/components.hpp"
#include "driver/system/inside_fluid.hpp"
#include "driver/system/phases.hpp"
#include "exchange/vtk_files.hpp"

namespace tanktread::driver {
namespace {

/// For two fields of vectors on the grid: the one, and its copy in a file.
void require_memory_for_grid(const Case& the_case) {
  const auto& box = the_case.flow.box;
  require_memory(2.0 * 3 * sizeof(double) * box[0] * box[1] * box[2], the_case.file.string() + ": flow.box");
}

void run(const SpreadStage& stage) {
  check_output({"--out", stage.out}, grid_output(), {{"--in", stage.in}});
  require_memory_for_grid(stage.the_case);
  const auto file = exchange::read_surface(stage.in);
  const auto surfaces = surfaces_of(file, stage.in.string());
  const auto force = vectors_of(file, "total_force", surfaces, stage.in.string());
  const auto coupler = make_coupler(stage.the_case);
  const auto grid_force = spread(*coupler, make_node_corrections(stage.the_case, *coupler),
                                 surfaces.positions, surfaces.triangles, force);
  exchange::write_grid(stage.out, grid_file(grid_force, "force", stage.the_case.flow.box,
                                            step_of(file.field_data, stage.in.string())));
}

void run(const MarkStage& stage) {
  check_output({"--out", stage.out}, grid_output(), {{"--in", stage.in}});
  require_memory_for_grid(stage.the_case);
  const auto file = exchange::read_surface(stage.in);
  const auto surfaces = surfaces_of(file, stage.in.string());
  coupler::InsideMarks marks(coupler_grid(stage.the_case), stage.the_case.run.threads);
  mark_inside(marks, surfaces.positions, surfaces.triangles, true);
  auto out =
      marks_file({}, marks.marks(), stage.the_case.flow.box, step_of(file.field_data, stage.in.string()));
  out.point_data.pop_back();  // all are news
  exchange::write_grid(stage.out, out);
}

/// What the tangential correction needs beside the velocity.
NodeVectors forces_to_correct_by(const exchange::SurfacePacket& file, const Surfaces& surfaces,
                                 const std::string& name) {
  const bool is_there =
      std::ranges::any_of(file.point_data, [](const auto& array) { return array.name == "total_force"; });
  if (!is_there) {
    throw InputError(fmt::format(
        "{}: array 'total_force' is missing, from which the tangential correction follows; give a file that "
        "has it (a membrane file of a run, --out of `tanktread membrane`), or "
        "--set coupler.tangential_correction=false",
        name));
  }
  return vectors_of(file, "total_force", surfaces, name);
}

void run(const InterpolateStage& stage) {
  check_output({"--out", stage.out}, surface_output(), {{"--in", stage.in}, {"--grid", stage.grid}});
  require_memory_for_grid(stage.the_case);
  const auto file = exchange::read_surface(stage.in);
  const auto surfaces = surfaces_of(file, stage.in.string());
  const auto grid = grid_vectors_of(exchange::read_grid(stage.grid), "velocity", stage.the_case.flow.box,
                                    stage.grid.string());
  const auto coupler = make_coupler(stage.the_case);
  const auto corrections = make_node_corrections(stage.the_case, *coupler);
  build_stencils(*coupler, corrections, surfaces.positions, surfaces.triangles);
  auto out = surface_file(surfaces, step_of(file.field_data, stage.in.string()));
  NodeVectors force;
  if (corrections.along_membrane) force = forces_to_correct_by(file, surfaces, stage.in.string());
  try {
    add_vectors(out, "velocity", velocity_of_nodes(*coupler, corrections, grid, surfaces, force));
  } catch (const coupler::CorrectionError& error) {
    throw InputError(stage.in.string() + ": " + error.what());
  } catch (const std::invalid_argument& error) {
    throw InputError(stage.grid.string() + ": " + error.what());
  }
  exchange::write_surface(stage.out, out);
}

/// Positions that stencils cannot be built at are those of the user's file.
template <class Stage>
void with_coupler_errors(const std::filesystem::path& in, Stage stage) {
  try {
    with_stage_errors(stage);
  } catch (const coupler::StencilError& error) {
    throw InputError(fmt::format("{}: {}", in.string(), error.what()));
  } catch (const coupler::InsideError& error) {
    throw InputError(fmt::format("{}: {}", in.string(), error.what()));
  }
}

}  // namespace

void run_stage(const SpreadStage& stage) {
  with_coupler_errors(stage.in, [&] { run(stage); });
}

void run_stage(const MarkStage& stage) {
  with_coupler_errors(stage.in, [&] { run(stage); });
}

void run_stage(const InterpolateStage& stage) {
  with_coupler_errors(stage.in, [&] { run(stage); });
}

}  // namespace tanktread::driver
