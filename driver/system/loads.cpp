#include "driver/system/loads.hpp"

#include "driver/units/load_units.hpp"

namespace tanktread::driver {

bool has_load(const CapsuleCase& capsule) {
  return capsule.load.force != 0;
}

membrane::EndPatches load_patches(const LoadCase& load, const membrane::TriangleMesh& start) {
  const auto& direction = load.direction;
  return membrane::end_patches(start, {direction[0], direction[1], direction[2]}, load.patch);
}

void add_loads(std::vector<CapsuleMembrane>& membranes, const Case& the_case, const Parameters& parameters,
               const std::vector<membrane::TriangleMesh>& starts) {
  for (std::size_t k = 0; k < membranes.size(); ++k) {
    const auto& capsule = the_case.capsules[k];
    if (!has_load(capsule)) continue;
    membranes[k].set_load(
        {membrane::end_forces(load_patches(capsule.load, starts[k]),
                              load_force(capsule, parameters.capsules[k]), starts[k].points.cols()),
         load_end(capsule.load, parameters)});
  }
}

}  // namespace tanktread::driver
