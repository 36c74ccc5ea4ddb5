#include "driver/plan/plan.hpp"

#include <fmt/format.h>

#include "driver/case/case_programs.hpp"
#include "driver/plan/sample.hpp"
#include "driver/plan/warnings.hpp"
#include "driver/program/memory.hpp"
#include "driver/system/placement.hpp"
#include "driver/system/run_ranks.hpp"
#include "driver/system/surface_files.hpp"
#include "driver/units/schedule.hpp"

namespace tanktread::driver {
namespace {

/// Before it is tried: where memory ends, the system ends a program without a word.
void require_memory_for(const Case& the_case, std::span<const MeshSize> sizes, double held_bytes) {
  const auto& box = the_case.flow.box;
  require_memory(memory_needed_bytes(the_case, sizes) - held_bytes,
                 fmt::format("{}: flow.box = [{}, {}, {}]", the_case.file.string(), box[0], box[1], box[2]));
}

/// Too large to be tried as a whole where a part of it is meant.
bool is_large(const Case& the_case, std::span<const MeshSize> sizes, double held_bytes) {
  constexpr double many_nodes = 256.0 * 256 * 256;
  double n_nodes = 1;
  for (const int n : the_case.flow.box) n_nodes *= n;
  return n_nodes > many_nodes || memory_needed_bytes(the_case, sizes) - held_bytes > available_memory_bytes();
}

/// What a plan says of the shapes, each looked at once.
struct ShapesSeen {
  std::vector<ShapeNumbers> numbers;
  std::vector<double> mean_edges;
  std::vector<Eigen::AlignedBox3d> boxes;
  LoadPatches patches;
};

void look_at(const CapsuleShape& shape, const CapsuleCase& capsule, ShapesSeen& seen) {
  seen.numbers.push_back(shape_numbers(shape));
  seen.mean_edges.push_back(seen.numbers.back().mean_edge);
  seen.boxes.emplace_back(shape.mesh.points.rowwise().minCoeff(), shape.mesh.points.rowwise().maxCoeff());
  seen.patches.push_back(load_patches_of(capsule, shape.mesh));
}

/// Makes the shapes of a case, with the hashes of the files that they are made of, so that an echo of the
/// case holds them. @param most_triangles of shapes that are held together
void make_shapes(Plan& plan, ShapesSeen& seen, std::int64_t most_triangles) {
  std::int64_t n_triangles = 0;
  for (std::size_t k = 0; k < plan.the_case.capsules.size(); ++k) {
    auto shape = capsule_shape(plan.the_case, k);
    look_at(shape, plan.the_case.capsules[k], seen);
    plan.sizes.push_back(size_of(shape.mesh));
    plan.the_case.capsules[k].mesh.file_hash = std::move(shape.mesh_hash);
    plan.the_case.capsules[k].stress_free.file_hash = std::move(shape.stress_free_hash);
    n_triangles += plan.sizes.back().n_triangles;
    if (n_triangles > most_triangles) {
      plan.shapes = {};
    } else {
      plan.shapes.meshes.push_back(std::move(shape.mesh));
      plan.shapes.stress_free.push_back(std::move(shape.stress_free));
    }
  }
}

/// Looks at shapes that are known.
void see_shapes(Plan& plan, ShapesSeen& seen) {
  plan.sizes = sizes_of(plan.shapes.meshes);
  for (std::size_t k = 0; k < plan.shapes.meshes.size(); ++k)
    look_at({plan.shapes.meshes[k], plan.shapes.stress_free[k], "", ""}, plan.the_case.capsules[k], seen);
}

}  // namespace

Plan make_plan(const Case& the_case, MembraneShapes shapes, double held_bytes, Trial trial) {
  Plan plan;
  plan.the_case = the_case;
  plan.parameters = parameters(the_case);
  plan.shapes = std::move(shapes);
  const bool is_shared = other_ranks() != nullptr || trial != Trial::whole;
  const bool are_known = !plan.shapes.meshes.empty();
  ShapesSeen seen;
  if (are_known) {
    see_shapes(plan, seen);
  } else {
    make_shapes(plan, seen, most_triangles(the_case, is_shared ? FileSizes::by_case : FileSizes::whole));
  }
  const bool are_held = !plan.shapes.meshes.empty() || the_case.capsules.empty();
  const auto made = made_shapes(the_case);
  const auto mesh_of = [&](std::size_t k) { return made(k).mesh; };
  const auto placement = are_held ? Placement(the_case, plan.shapes.meshes)
                                  : Placement(the_case, std::move(seen.boxes), mesh_of);
  std::vector<std::string> remarks;
  if (!are_known) {
    check_placement(the_case, placement);
    remarks = remarks_on_mesh_files(the_case);
  }
  // A program of the user's is not tried: a run starts it once.
  const bool is_tried = trial != Trial::none && !has_program(the_case);
  const bool as_sample = is_shared && (!are_held || is_large(the_case, plan.sizes, held_bytes));
  if (!as_sample && trial != Trial::none) require_memory_for(the_case, plan.sizes, held_bytes);
  last_step_of(the_case, plan.parameters);  // which there may not be
  const auto probe = !is_tried   ? Probe()
                     : as_sample ? try_sample(the_case, plan.parameters, plan.sizes, made)
                                 : try_case(the_case, plan.parameters, plan.shapes);
  plan.cost = predict_cost(the_case, plan.parameters, plan.sizes, probe);
  auto warning_lines = warnings(the_case, plan.parameters, seen.mean_edges, placement);
  warning_lines.insert(warning_lines.begin(), remarks.begin(), remarks.end());
  if (as_sample && is_tried) {
    warning_lines.push_back(
        "the case is large: its speed is concluded from a sample, a smaller box with one capsule");
  }
  if (!probe.breakdown.empty()) {
    warning_lines.push_back("the first steps of the case, tried now, break down: " + probe.breakdown);
  }
  plan.echo = echo(the_case, plan.parameters, plan.cost, warning_lines, seen.numbers, seen.patches);
  return plan;
}

}  // namespace tanktread::driver
