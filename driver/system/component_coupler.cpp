#include "driver/system/components.hpp"
#include "driver/units/flow_units.hpp"

namespace tanktread::driver {

std::unique_ptr<coupler::Coupler> make_coupler(const Case& the_case) {
  coupler::Grid grid{the_case.flow.box, {true, true, true}};
  if (the_case.flow.kind != "periodic") grid.periodic[the_case.flow.wall_axis] = false;
  return std::make_unique<coupler::Coupler>(grid, coupler::kernel(the_case.coupler.kernel),
                                            the_case.run.threads);
}

std::optional<coupler::TangentialCorrection> make_tangential_correction(const Case& the_case,
                                                                        const coupler::Coupler& coupler) {
  if (!the_case.coupler.tangential_correction) return std::nullopt;
  return coupler::TangentialCorrection(coupler, flow_parameters(the_case).kinematic_viscosity);  // density 1
}

}  // namespace tanktread::driver
