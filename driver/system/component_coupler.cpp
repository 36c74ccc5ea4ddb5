#include "driver/system/components.hpp"
#include "driver/units/flow_units.hpp"

namespace tanktread::driver {

std::unique_ptr<coupler::Coupler> make_coupler(const Case& the_case) {
  coupler::Grid grid{the_case.flow.box, {true, true, true}};
  if (the_case.flow.kind != "periodic") grid.periodic[the_case.flow.wall_axis] = false;
  return std::make_unique<coupler::Coupler>(grid, coupler::kernel(the_case.coupler.kernel),
                                            the_case.run.threads);
}

NodeCorrections make_node_corrections(const Case& the_case, const coupler::Coupler& coupler) {
  NodeCorrections corrections;
  corrections.keeps_volume = the_case.coupler.keep_volume;
  if (the_case.coupler.tangential_correction) {
    corrections.along_membrane.emplace(coupler, flow_parameters(the_case).kinematic_viscosity);  // density 1
    corrections.normals = std::make_unique<coupler::NodeNormals>(the_case.run.threads);
  }
  return corrections;
}

}  // namespace tanktread::driver
