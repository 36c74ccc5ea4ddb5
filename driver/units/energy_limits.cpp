#include "driver/units/energy_limits.hpp"

#include "driver/units/stability.hpp"

namespace tanktread::driver {
namespace {

// Over the limit of a spring (stability.hpp), by docs/energy-terms.md, "How stiff".
constexpr double bending_in_springs = 0.3;    ///< kappa_b/h^2
constexpr double local_area_in_springs = 2;   ///< k_d
constexpr double global_area_in_springs = 1;  ///< k_A/a
constexpr double volume_in_springs = 1;       ///< k_V

}  // namespace

std::vector<EnergyLimit> energy_limits(const Case& the_case, const Parameters& parameters, std::size_t number,
                                       double mean_edge) {
  const auto& capsule = parameters.capsules[number];
  const auto& coupler = the_case.coupler;
  const double spring = stable_interval_times_spring(coupler.kernel, coupler.tangential_correction) *
                        parameters.kinematic_viscosity;
  const auto& energy = capsule.energy;
  const EnergyLimit all[] = {
      {"kappa_b", "bending_modulus", energy.bending_modulus,
       bending_in_springs * spring * mean_edge * mean_edge},
      {"k_A", "global_area_modulus", energy.global_area_modulus,
       global_area_in_springs * spring * capsule.radius},
      {"k_d", "local_area_modulus", energy.local_area_modulus, local_area_in_springs * spring},
      {"k_V", "volume_modulus", energy.volume_modulus, volume_in_springs * spring},
  };
  std::vector<EnergyLimit> limits;
  for (const auto& limit : all)
    if (limit.value > 0 && limit.most > 0) limits.push_back(limit);
  return limits;
}

}  // namespace tanktread::driver
