#include "driver/system/system.hpp"

#include <fmt/format.h>
#include <omp.h>

#include "driver/system/components.hpp"
#include "driver/system/phases.hpp"

namespace tanktread::driver {

System make_system(const Case& the_case, const Parameters& parameters,
                   const std::vector<membrane::TriangleMesh>& meshes) {
  System system;
  system.shear_rate = parameters.shear_rate;
  system.threads = the_case.run.threads > 0 ? the_case.run.threads : omp_get_max_threads();
  system.fluid = make_fluid(the_case, parameters);
  system.coupler = make_coupler(the_case);
  system.corrections = make_node_corrections(the_case, *system.coupler);
  system.implicit = implicit_settings(the_case);
  system.membranes = make_membranes(the_case, parameters, meshes);
  system.node_velocity = system.node_force = zero_like(positions_of(system.membranes));
  try {
    build_stencils(*system.coupler, positions_of(system.membranes));
  } catch (const coupler::StencilError& error) {
    throw InputError(
        fmt::format("{}; move the capsule (capsule.N.position) or enlarge flow.box", error.what()));
  }
  return system;
}

}  // namespace tanktread::driver
