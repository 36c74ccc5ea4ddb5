#include "driver/plan/plan.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>

#include "driver/case/case_programs.hpp"
#include "driver/plan/warnings.hpp"
#include "driver/system/components.hpp"
#include "driver/system/step.hpp"
#include "driver/units/schedule.hpp"
#include "fluid/lattice_boltzmann.hpp"

namespace tanktread::driver {
namespace {

/// Million node updates a second of the first steps of the case, for a second or a tenth of the run; 0 if it
/// breaks down within them.
double measure_speed(const Case& the_case, const Parameters& parameters,
                     const std::vector<membrane::TriangleMesh>& meshes) {
  constexpr double probe_seconds = 1.0;
  constexpr int n_warm_up = 2, n_least = 3;
  const auto n_enough = std::max<std::int64_t>(n_least, last_step_of(the_case, parameters) / 10);
  try {
    auto system = make_system(the_case, parameters, meshes);
    for (int k = 0; k < n_warm_up; ++k) advance(system);
    const auto start = std::chrono::steady_clock::now();
    double seconds = 0;
    std::int64_t n_steps = 0;
    while (n_steps < n_least || (seconds < probe_seconds && n_steps < n_enough)) {
      advance(system);
      ++n_steps;
      seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    }
    return 1e-6 * static_cast<double>(n_steps) * static_cast<double>(system.fluid->shape().size()) / seconds;
  } catch (const RunError&) {
    return 0.0;  // the run itself will say what is wrong, and when
  }
}

double physical_memory_bytes() {
  return static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGE_SIZE));
}

double times_written(double every, const Case& the_case, const Parameters& parameters) {
  const auto schedule = schedule_of(every, parameters);
  if (schedule.interval == 0) return 0.0;
  return 1.0 + static_cast<double>(last_step_of(the_case, parameters) / schedule.interval);
}

Cost predict_cost(const Case& the_case, const Parameters& parameters,
                  const std::vector<membrane::TriangleMesh>& meshes) {
  const auto& box = the_case.flow.box;
  const double n_nodes = static_cast<double>(box[0]) * box[1] * box[2];
  double membrane_nodes = 0, triangles = 0;
  for (const auto& mesh : meshes) {
    membrane_nodes += static_cast<double>(mesh.points.cols());
    triangles += static_cast<double>(mesh.triangles.cols());
  }
  Cost cost;
  // The lattice, once more while a checkpoint is written; about 2 kB a membrane node.
  cost.memory_bytes = 2 * n_nodes * fluid::lattice_boltzmann_memory_per_node + 2048 * membrane_nodes;
  // What does not fit is not tried: the system would end the program without a word.
  // Nor is a program of the user's, which a run starts once.
  if (cost.memory_bytes < physical_memory_bytes() && !has_program(the_case))
    cost.mlups = measure_speed(the_case, parameters, meshes);
  const double n_steps = static_cast<double>(last_step_of(the_case, parameters));
  if (cost.mlups > 0) cost.run_seconds = 1e-6 * n_steps * n_nodes / cost.mlups;

  double fluid_output_nodes = n_nodes;
  if (the_case.output.fluid_box) {
    fluid_output_nodes = 1;
    for (const auto& range : *the_case.output.fluid_box) fluid_output_nodes *= range[1] - range[0] + 1;
  }
  constexpr double fluid_record = 7 * 8, node_record = (3 + 9) * 8, triangle_record = (22 + 3 + 1) * 8 + 1;
  // A checkpoint has the membrane's record, reference positions, and of a triangle its normal and viscous
  // history.
  constexpr double observables_row_bytes = 300, n_checkpoints = 2;
  constexpr double checkpoint_node = node_record + 3 * 8, checkpoint_triangle = triangle_record + (3 + 9) * 8;
  cost.disk_bytes =
      times_written(the_case.output.fluid_every, the_case, parameters) * fluid_record * fluid_output_nodes +
      times_written(the_case.output.membrane_every, the_case, parameters) *
          (node_record * membrane_nodes + triangle_record * triangles) +
      times_written(the_case.output.observables_every, the_case, parameters) * observables_row_bytes *
          static_cast<double>(meshes.size()) +
      n_checkpoints * (n_nodes * fluid::lattice_boltzmann_memory_per_node + checkpoint_node * membrane_nodes +
                       checkpoint_triangle * triangles);
  return cost;
}

}  // namespace

Plan make_plan(const Case& the_case, std::vector<membrane::TriangleMesh> meshes) {
  Plan plan;
  plan.the_case = the_case;
  plan.parameters = parameters(the_case);
  if (meshes.empty()) meshes = reference_meshes(the_case);
  plan.meshes = std::move(meshes);
  std::vector<double> mean_edges;
  for (const auto& mesh : plan.meshes) mean_edges.push_back(membrane::inspect(mesh).edge_mean);
  plan.cost = predict_cost(the_case, plan.parameters, plan.meshes);
  auto warning_lines = warnings(the_case, plan.parameters, mean_edges);
  if (plan.cost.memory_bytes > physical_memory_bytes()) {
    warning_lines.push_back(
        fmt::format("flow.box needs about {:.1f} GB of memory, this machine has {:.1f} GB; make it smaller",
                    1e-9 * plan.cost.memory_bytes, 1e-9 * physical_memory_bytes()));
  }
  plan.echo = echo(the_case, plan.parameters, plan.cost, warning_lines, mean_edges);
  return plan;
}

}  // namespace tanktread::driver
