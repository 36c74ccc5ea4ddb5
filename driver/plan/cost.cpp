#include "driver/plan/cost.hpp"

#include <algorithm>
#include <cmath>

#include "driver/case/case_geometry.hpp"
#include "driver/case/names.hpp"
#include "driver/system/components.hpp"
#include "driver/system/loads.hpp"
#include "driver/units/laws.hpp"
#include "driver/units/schedule.hpp"
#include "fluid/lattice_boltzmann.hpp"

namespace tanktread::driver {
namespace {

constexpr double kept_checkpoints = 2;

struct Sizes {
  double grid_nodes, fluid_file_nodes, membrane_nodes = 0, triangles = 0;
  double own_stress_free_nodes = 0;  ///< of membranes that start elsewhere
};

double n_nodes(const std::array<int, 3>& box) {
  return static_cast<double>(box[0]) * box[1] * box[2];
}

Sizes sizes_of(const Case& the_case, std::span<const MeshSize> meshes) {
  Sizes sizes{n_nodes(the_case.flow.box), n_nodes(the_case.flow.box)};
  if (the_case.output.fluid_box) {
    sizes.fluid_file_nodes = 1;
    for (const auto& range : *the_case.output.fluid_box) sizes.fluid_file_nodes *= range[1] - range[0] + 1;
  }
  for (std::size_t k = 0; k < meshes.size(); ++k) {
    const auto n_nodes = static_cast<double>(meshes[k].n_nodes);
    sizes.membrane_nodes += n_nodes;
    sizes.triangles += static_cast<double>(meshes[k].n_triangles);
    if (has_own_stress_free_shape(the_case.capsules[k])) sizes.own_stress_free_nodes += n_nodes;
  }
  return sizes;
}

double sum_over(const std::vector<FilesCost>& files, double (*term)(const FilesCost&)) {
  double sum = 0;
  for (const auto& kind : files) sum += term(kind);
  return sum;
}

}  // namespace

double Cost::disk_bytes() const {
  return sum_over(files, [](const FilesCost& kind) { return kind.n_kept * kind.bytes; });
}

double Cost::disk_peak_bytes() const {
  return disk_bytes() +
         sum_over(files, [](const FilesCost& kind) { return kind.n_written > kind.n_kept ? kind.bytes : 0; });
}

double Cost::write_seconds() const {
  return sum_over(files, [](const FilesCost& kind) { return kind.n_written * kind.seconds; });
}

double membrane_memory_bytes(const Case& the_case, std::size_t capsule, double n_nodes) {
  // A membrane node with its two triangles, at work and in a file; their history. An implicit viscosity has
  // its operator twice (now, and the step before), and the vectors of its solution.
  constexpr double node = 1500, node_history = 500, node_operator = 2300;
  const auto& scheme = the_case.capsules[capsule].membrane.viscous.scheme;
  const double history = scheme == "none" ? 0 : scheme == implicit_scheme ? node_operator : node_history;
  // Slopes and normals of two sets of stencils.
  const double width = std::ceil(2 * kernel_half_width(the_case.coupler.kernel).value_or(0));
  const double dipole = has_contrast(the_case) && the_case.coupler.shear_dipole ? 2 * (3 * width + 3) * 8 : 0;
  return (node + history + dipole) * n_nodes;
}

double memory_needed_bytes(const Case& the_case, std::span<const MeshSize> meshes) {
  double bytes = program_memory_bytes + fluid_memory_bytes(the_case.flow);
  // A mark, a viscosity, and that in a state.
  if (has_contrast(the_case)) bytes += (4 + 8 + 8) * n_nodes(the_case.flow.box);
  for (std::size_t k = 0; k < meshes.size(); ++k)
    bytes += membrane_memory_bytes(the_case, k, static_cast<double>(meshes[k].n_nodes));
  return bytes;
}

Cost predict_cost(const Case& the_case, const Parameters& parameters, std::span<const MeshSize> meshes,
                  const Probe& probe) {
  const auto sizes = sizes_of(the_case, meshes);
  const auto last_step = last_step_of(the_case, parameters);
  const auto times = [&](double every) {
    return static_cast<double>(times_due(schedule_of(every, parameters), last_step));
  };
  constexpr double fluid_record = 7 * 8, node_record = (3 + 9) * 8, triangle_record = (22 + 3 + 1) * 8 + 1;
  // A checkpoint has the membrane's record, reference positions and perhaps first ones, and of a triangle its
  // normal and viscous history.
  constexpr double checkpoint_node = node_record + 3 * 8, checkpoint_triangle = triangle_record + (3 + 9) * 8;
  constexpr double observables_row = 300, measures_row = 350, number = 19;

  // Two columns more for each energy beside the laws.
  const double energy_row = 270 + 2 * number * static_cast<double>(term_names(parameters).size());

  // The forces of loads, on all nodes if on any.
  const bool loaded = std::ranges::any_of(the_case.capsules, has_load);
  const double load_record = loaded ? 3 * 8 : 0;
  // The marks in a fluid file; the viscosities in a state.
  const double contrast_record = has_contrast(the_case) ? 8 : 0;
  const double fluid_bytes = (fluid_record + contrast_record) * sizes.fluid_file_nodes;
  const double membrane_bytes =
      (node_record + load_record) * sizes.membrane_nodes + triangle_record * sizes.triangles;
  const double lattice_bytes = (fluid::lattice_boltzmann_state_per_node + contrast_record) * sizes.grid_nodes;
  const double checkpoint_bytes = lattice_bytes + (checkpoint_node + load_record) * sizes.membrane_nodes +
                                  3 * 8 * sizes.own_stress_free_nodes + checkpoint_triangle * sizes.triangles;
  const double n_rows = times(the_case.output.observables_every),
               n_measures = times(the_case.output.measures_every),
               n_energy = times(the_case.output.energy_every),
               n_membrane = times(the_case.output.membrane_every),
               n_fluid = times(the_case.output.fluid_every),
               n_checkpoints = times(the_case.run.checkpoint_every);

  Cost cost;
  cost.memory_bytes = memory_needed_bytes(the_case, meshes);
  cost.files = {
      {"observables", n_rows, n_rows, observables_row * static_cast<double>(meshes.size()),
       probe.observables_seconds},
      {"measures", n_measures, n_measures, measures_row * static_cast<double>(meshes.size()),
       probe.measures_seconds},
      {"energy", n_energy, n_energy, energy_row, probe.energy_seconds},
      {"membrane files", n_membrane, n_membrane, membrane_bytes, probe.membrane_file_seconds},
      {"fluid files", n_fluid, n_fluid, fluid_bytes, probe.grid_seconds_per_byte * fluid_bytes},
      {"checkpoints", n_checkpoints, std::min(kept_checkpoints, n_checkpoints), checkpoint_bytes,
       probe.membrane_file_seconds + probe.grid_seconds_per_byte * lattice_bytes},
  };
  cost.mlups = probe.mlups;
  cost.fluid_node_seconds = probe.fluid_node_seconds;
  cost.membrane_node_seconds = probe.membrane_node_seconds;
  cost.breakdown = probe.breakdown;
  if (probe.mlups > 0)
    cost.step_seconds = 1e-6 * static_cast<double>(last_step) * sizes.grid_nodes / probe.mlups;
  return cost;
}

}  // namespace tanktread::driver
