#include <fmt/format.h>

#include <memory>
#include <numeric>
#include <utility>
#include <vector>

#include "driver/packets/fluid_files.hpp"
#include "driver/packets/packet_files.hpp"
#include "driver/packets/saved_state.hpp"
#include "driver/program/memory.hpp"
#include "driver/program/output_file.hpp"
#include "driver/stages/stage_errors.hpp"
#include "driver/stages/stages.hpp"
#include "driver/stages/state_case.hpp"
#include "driver/system/components.hpp"
#include "driver/system/phases.hpp"
#include "exchange/vtk_files.hpp"

namespace tanktread::driver {
namespace {

void restore(fluid::Fluid& fluid, const std::filesystem::path& file) {
  auto content = exchange::read_grid(file);
  const auto shape = fluid.shape();
  check_grid(content, {shape.nx, shape.ny, shape.nz}, file.string());
  try {
    fluid.restore(state_of(std::move(content), file.string()));
  } catch (const std::invalid_argument& error) {
    throw InputError(fmt::format("{}: does not fit the case: {}", file.string(), error.what()));
  }
}

/// @return the capsule that each node is in, where --inside says it of all nodes; else nothing, for a state
/// has viscosities alone
std::vector<std::int32_t> take_steps(fluid::Fluid& fluid, const FluidStage& stage) {
  GridVectors force;
  if (!stage.force.empty()) {
    force = grid_vectors_of(exchange::read_grid(stage.force), "force", stage.the_case.flow.box,
                            stage.force.string());
  }
  std::vector<std::int32_t> inside;
  if (!stage.inside.empty()) {
    auto marks = grid_marks_of(exchange::read_grid(stage.inside), stage.the_case.capsules.size(),
                               stage.the_case.flow.box, stage.inside.string());
    set_viscosity(fluid, marks, viscosities_of_marks(stage.the_case));
    if (std::ssize(marks.capsule) == fluid.shape().size()) inside = std::move(marks.capsule);
  }
  for (std::int64_t k = 0; k < stage.n_steps; ++k) advance_fluid(fluid, force);
  return inside;
}

void check_places(const FluidStage& stage) {
  if (!stage.free.empty() && !stage.the_case.flow.command.empty()) {
    throw InputError(
        "--free: a program in the place of the fluid (flow.command) is not asked for the velocity without "
        "forces; "
        "leave out --free");
  }
  // A state may be carried on in its place.
  check_output({"--out", stage.out}, grid_output(), {{"--force", stage.force}, {"--inside", stage.inside}});
  std::vector<NamedFile> before = {{"--out", stage.out}};
  for (const auto& output : {NamedFile{"--fields", stage.fields}, NamedFile{"--free", stage.free}}) {
    if (output.file.empty()) continue;
    check_output(output, grid_output(),
                 {{"--state", stage.state}, {"--force", stage.force}, {"--inside", stage.inside}});
    for (const auto& other : before) {
      if (std::filesystem::weakly_canonical(output.file) != std::filesystem::weakly_canonical(other.file))
        continue;
      throw InputError(fmt::format("{} and {} name one file, {}; give two names", output.option, other.option,
                                   other.file.string()));
    }
    before.push_back(output);
  }
}

/// That of the step which follows on `step`.
void write_free_velocity(const fluid::Fluid& fluid, const FluidStage& stage, std::int64_t step) {
  std::vector<std::int64_t> all(static_cast<std::size_t>(fluid.shape().size()));
  std::iota(all.begin(), all.end(), 0);
  const auto free = free_velocity(fluid, std::make_shared<const std::vector<std::int64_t>>(std::move(all)));
  exchange::write_grid(stage.free, grid_file(free, "velocity", stage.the_case.flow.box, step + 1));
}

void run(const FluidStage& stage) {
  check_places(stage);
  // The lattice, and once more as the state to write.
  const auto& box = stage.the_case.flow.box;
  const double free_bytes = stage.free.empty() ? 0 : 2.0 * 5 * sizeof(double) * box[0] * box[1] * box[2];
  require_memory(fluid_memory_bytes(stage.the_case.flow) + free_bytes,
                 stage.the_case.file.string() + ": flow.box");
  const auto numbers = flow_parameters(stage.the_case);
  const auto fluid = make_fluid(stage.the_case, numbers);
  if (!stage.state.empty()) {
    note_other_case(stage.state, stage.the_case, "flow.");
    restore(*fluid, stage.state);
  }
  const auto inside = take_steps(*fluid, stage);
  auto state = fluid->state();
  const auto step = state.step;
  exchange::write_grid(stage.out, state_file(std::move(state), fluid->shape()));
  if (!stage.free.empty()) write_free_velocity(*fluid, stage, step);
  if (stage.fields.empty()) return;
  exchange::write_grid(stage.fields, flow_file(*fluid, std::nullopt, step,
                                               static_cast<double>(step) * numbers.shear_rate, inside));
}

}  // namespace

void run_stage(const FluidStage& stage) {
  with_stage_errors<fluid::Breakdown>([&] { run(stage); });
}

}  // namespace tanktread::driver
