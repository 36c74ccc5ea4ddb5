#include "driver/system/system.hpp"

#include <fmt/format.h>
#include <omp.h>

#include "driver/system/components.hpp"
#include "driver/system/fluid_on_ranks.hpp"
#include "driver/system/membrane_files.hpp"
#include "driver/system/phases.hpp"
#include "driver/system/run_ranks.hpp"

namespace tanktread::driver {

namespace {

void mark_start(System& system) {
  const auto surfaces = surfaces_of(system.membranes);
  try {
    set_viscosity(*system.fluid, mark_inside(*system.inside, surfaces.positions, surfaces.triangles, true),
                  system.viscosity_of_marks);
  } catch (const coupler::InsideError& error) {
    throw InputError(fmt::format("{}; move the capsule (capsule.N.position)", error.what()));
  }
}

}  // namespace

std::unique_ptr<FluidOnRanks> make_fluid_on_ranks(const Case& the_case, const FlowParameters& parameters) {
  const auto division = division_of(the_case, other_ranks()->size());
  if (!the_case.flow.command.empty())
    throw InputError("flow.command: a program in the place of the fluid has one rank; start without mpirun");
  return std::make_unique<FluidOnRanks>(*other_ranks(), division, fluid_settings(the_case, parameters));
}

System make_system(const Case& the_case, const Parameters& parameters, const MembraneShapes& shapes,
                   Sharing sharing) {
  System system;
  system.shear_rate = parameters.shear_rate;
  system.threads = the_case.run.threads > 0 ? the_case.run.threads : omp_get_max_threads();
  // Of one rank whatever run.ranks says: plan may be asked here.
  if (other_ranks() && sharing == Sharing::all_ranks) {
    system.fluid = make_fluid_on_ranks(the_case, parameters);
  } else {
    system.fluid = make_fluid(the_case, parameters);
  }
  system.coupler = make_coupler(the_case);
  system.corrections = make_node_corrections(the_case, *system.coupler);
  system.implicit = implicit_settings(the_case);
  system.membranes = make_membranes(the_case, parameters, shapes);
  system.node_velocity = system.node_force = zero_like(positions_of(system.membranes));
  try {
    const auto surfaces = surfaces_of(system.membranes);
    build_stencils(*system.coupler, system.corrections, surfaces.positions, surfaces.triangles);
  } catch (const coupler::StencilError& error) {
    throw InputError(
        fmt::format("{}; move the capsule (capsule.N.position) or enlarge flow.box", error.what()));
  }
  system.inside = make_inside(the_case);
  if (system.inside) {
    system.viscosity_of_marks = viscosities_of_marks(the_case);
    mark_start(system);
  }
  return system;
}

}  // namespace tanktread::driver
