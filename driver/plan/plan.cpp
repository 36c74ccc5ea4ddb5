#include "driver/plan/plan.hpp"

#include <fmt/format.h>

#include "driver/case/case_programs.hpp"
#include "driver/plan/warnings.hpp"
#include "driver/program/memory.hpp"
#include "driver/system/components.hpp"
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

/// The reference meshes, and the hashes of the files that they are made of, so that an echo of the case holds
/// them.
void make_meshes(Plan& plan) {
  for (std::size_t k = 0; k < plan.the_case.capsules.size(); ++k) {
    auto [mesh, hash] = reference_mesh(plan.the_case, k);
    plan.meshes.push_back(std::move(mesh));
    plan.the_case.capsules[k].mesh.file_hash = std::move(hash);
  }
}

}  // namespace

Plan make_plan(const Case& the_case, std::vector<membrane::TriangleMesh> meshes, double held_bytes) {
  Plan plan;
  plan.the_case = the_case;
  plan.parameters = parameters(the_case);
  plan.meshes = std::move(meshes);
  std::vector<std::string> remarks;
  if (plan.meshes.empty()) {
    make_meshes(plan);
    check_placement(the_case, plan.meshes);
    remarks = remarks_on_mesh_files(the_case);
  }
  std::vector<double> mean_edges;
  for (const auto& mesh : plan.meshes) mean_edges.push_back(membrane::inspect(mesh).edge_mean);
  require_memory_for(the_case, plan.meshes, held_bytes);
  last_step_of(the_case, plan.parameters);  // which there may not be
  // A program of the user's is not tried: a run starts it once.
  const auto probe = has_program(the_case) ? Probe() : try_case(the_case, plan.parameters, plan.meshes);
  plan.cost = predict_cost(the_case, plan.parameters, plan.meshes, probe);
  auto warning_lines = warnings(the_case, plan.parameters, mean_edges, Placement(the_case, plan.meshes));
  warning_lines.insert(warning_lines.begin(), remarks.begin(), remarks.end());
  if (!probe.breakdown.empty()) {
    warning_lines.push_back("the first steps of the case, tried now, break down: " + probe.breakdown);
  }
  plan.echo = echo(the_case, plan.parameters, plan.cost, warning_lines, mean_edges,
                   load_patches_of(the_case, plan.meshes));
  return plan;
}

}  // namespace tanktread::driver
