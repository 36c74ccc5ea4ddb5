#include "driver/components.hpp"

namespace tanktread::driver {

std::unique_ptr<coupler::Coupler> make_coupler(const Case& the_case) {
  coupler::Grid grid{the_case.flow.box, {true, true, true}};
  if (the_case.flow.kind != "periodic") grid.periodic[the_case.flow.wall_axis] = false;
  return std::make_unique<coupler::Coupler>(grid, coupler::kernel(the_case.coupler.kernel),
                                            the_case.run.threads);
}

}  // namespace tanktread::driver
