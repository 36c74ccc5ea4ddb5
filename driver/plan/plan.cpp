#include "driver/plan/plan.hpp"

#include <fmt/format.h>

#include "driver/case/case_programs.hpp"
#include "driver/plan/sample.hpp"
#include "driver/plan/warnings.hpp"
#include "driver/program/memory.hpp"
#include "driver/system/capsule_shape.hpp"
#include "driver/system/placement.hpp"
#include "driver/units/schedule.hpp"

namespace tanktread::driver {
namespace {

/// Before it is tried: where memory ends, the system ends a program without a word.
void require_memory_for(const Case& the_case, const std::vector<membrane::TriangleMesh>& meshes,
                        double held_bytes) {
  const auto& box = the_case.flow.box;
  require_memory(memory_needed_bytes(the_case, meshes) - held_bytes,
                 fmt::format("{}: flow.box = [{}, {}, {}]", the_case.file.string(), box[0], box[1], box[2]));
}

/// Too large to be tried as a whole where a part of it is meant.
bool is_large(const Case& the_case, const std::vector<membrane::TriangleMesh>& meshes, double held_bytes) {
  constexpr double many_nodes = 256.0 * 256 * 256;
  double n_nodes = 1;
  for (const int n : the_case.flow.box) n_nodes *= n;
  return n_nodes > many_nodes ||
         memory_needed_bytes(the_case, meshes) - held_bytes > available_memory_bytes();
}

/// The shapes, and the hashes of the files that they are made of, so that an echo of the case holds them.
void make_shapes(Plan& plan) {
  for (std::size_t k = 0; k < plan.the_case.capsules.size(); ++k) {
    auto shape = capsule_shape(plan.the_case, k);
    plan.shapes.meshes.push_back(std::move(shape.mesh));
    plan.shapes.stress_free.push_back(std::move(shape.stress_free));
    plan.the_case.capsules[k].mesh.file_hash = std::move(shape.mesh_hash);
    plan.the_case.capsules[k].stress_free.file_hash = std::move(shape.stress_free_hash);
  }
}

}  // namespace

Plan make_plan(const Case& the_case, MembraneShapes shapes, double held_bytes, Trial trial) {
  Plan plan;
  plan.the_case = the_case;
  plan.parameters = parameters(the_case);
  plan.shapes = std::move(shapes);
  const auto& meshes = plan.shapes.meshes;
  std::vector<std::string> remarks;
  if (meshes.empty()) {
    make_shapes(plan);
    check_placement(the_case, meshes);
    remarks = remarks_on_mesh_files(the_case);
  }
  const auto numbers = shape_numbers(plan.shapes);
  std::vector<double> mean_edges;
  for (const auto& shape : numbers) mean_edges.push_back(shape.mean_edge);
  const bool as_sample = trial == Trial::sample && is_large(the_case, meshes, held_bytes);
  if (!as_sample) require_memory_for(the_case, meshes, held_bytes);
  last_step_of(the_case, plan.parameters);  // which there may not be
  // A program of the user's is not tried: a run starts it once.
  const auto probe = has_program(the_case) ? Probe()
                     : as_sample           ? try_sample(the_case, plan.parameters, meshes)
                                           : try_case(the_case, plan.parameters, plan.shapes);
  plan.cost = predict_cost(the_case, plan.parameters, meshes, probe);
  auto warning_lines = warnings(the_case, plan.parameters, mean_edges, Placement(the_case, meshes));
  warning_lines.insert(warning_lines.begin(), remarks.begin(), remarks.end());
  if (as_sample) {
    warning_lines.push_back(
        "the box is large: its speed is concluded from a sample, a smaller box with one capsule");
  }
  if (!probe.breakdown.empty()) {
    warning_lines.push_back("the first steps of the case, tried now, break down: " + probe.breakdown);
  }
  plan.echo = echo(the_case, plan.parameters, plan.cost, warning_lines, numbers,
                   load_patches_of(the_case, plan.shapes.meshes));
  return plan;
}

}  // namespace tanktread::driver
