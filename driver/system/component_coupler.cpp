#include "driver/system/components.hpp"
#include "driver/units/flow_units.hpp"

namespace tanktread::driver {

coupler::Grid coupler_grid(const Case& the_case) {
  coupler::Grid grid{the_case.flow.box, {true, true, true}};
  if (the_case.flow.kind != "periodic") grid.periodic[the_case.flow.wall_axis] = false;
  return grid;
}

std::unique_ptr<coupler::Coupler> make_coupler(const Case& the_case) {
  return std::make_unique<coupler::Coupler>(coupler_grid(the_case), coupler::kernel(the_case.coupler.kernel),
                                            the_case.run.threads);
}

namespace {

/// Of the fluid on both sides of each membrane. Where they differ the harmonic mean: the velocity along the
/// membrane has the slopes (tau + f/2)/mu_i and (tau - f/2)/mu_o, with tau the mean of the stresses on both
/// sides, and the kink that a force f makes is f (1/mu_i + 1/mu_o)/2 on either (docs/kernels.md).
std::vector<double> viscosities_of_surfaces(const Case& the_case) {
  const double outer = flow_parameters(the_case).kinematic_viscosity;  // density 1
  std::vector<double> viscosities;
  for (const auto& capsule : the_case.capsules)
    viscosities.push_back(capsule.viscosity_ratio == 1 ? outer
                                                       : outer * 2 / (1 + 1 / capsule.viscosity_ratio));
  return viscosities;
}

}  // namespace

NodeCorrections make_node_corrections(const Case& the_case, const coupler::Coupler& coupler) {
  NodeCorrections corrections;
  corrections.keeps_volume = the_case.coupler.keep_volume;
  if (the_case.coupler.tangential_correction) {
    corrections.along_membrane.emplace(coupler, viscosities_of_surfaces(the_case));
    corrections.normals = std::make_unique<coupler::NodeNormals>(the_case.run.threads);
  }
  return corrections;
}

}  // namespace tanktread::driver
