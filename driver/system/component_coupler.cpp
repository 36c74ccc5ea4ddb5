#include <algorithm>

#include "coupler/two_fluids.hpp"
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

/// On the sides of each membrane.
std::vector<coupler::SideViscosities> viscosities_of_sides(const Case& the_case) {
  const double outer = flow_parameters(the_case).kinematic_viscosity;  // density 1
  std::vector<coupler::SideViscosities> sides;
  for (const auto& capsule : the_case.capsules) sides.push_back({outer, capsule.viscosity_ratio * outer});
  return sides;
}

/// One a surface; those of a viscosity seen before are taken over, for each is a sum over many places.
std::vector<double> dipole_lengths_of(const std::vector<coupler::SideViscosities>& sides,
                                      const coupler::Kernel& kernel) {
  std::vector<double> lengths;
  for (const auto& side : sides) {
    const auto same = [&](const auto& other) {
      return other.inner == side.inner && other.outer == side.outer;
    };
    const auto first = static_cast<std::size_t>(std::ranges::find_if(sides, same) - sides.begin());
    lengths.push_back(first < lengths.size() ? lengths[first] : coupler::dipole_length(kernel, side));
  }
  return lengths;
}

coupler::TangentialCorrection correction_of(const std::vector<coupler::SideViscosities>& sides,
                                            const std::vector<double>& dipole_lengths,
                                            const coupler::Coupler& coupler) {
  if (std::ranges::all_of(sides, [](const auto& side) { return side.inner == side.outer; }))
    return {coupler, sides.front().outer};
  coupler::TangentialCorrection::Shortfalls shortfalls;
  for (std::size_t k = 0; k < sides.size(); ++k) {
    shortfalls.of_surfaces.push_back(coupler::tangential_shortfall(
        coupler.kernel(), sides[k], dipole_lengths.empty() ? 0 : dipole_lengths[k]));
  }
  return {coupler, shortfalls};
}

}  // namespace

NodeCorrections make_node_corrections(const Case& the_case, const coupler::Coupler& coupler) {
  NodeCorrections corrections;
  corrections.keeps_volume = the_case.coupler.keep_volume;
  const auto sides = viscosities_of_sides(the_case);
  if (the_case.coupler.shear_dipole && has_contrast(the_case))
    corrections.dipole_lengths = dipole_lengths_of(sides, coupler.kernel());
  if (the_case.coupler.tangential_correction)
    corrections.along_membrane.emplace(correction_of(sides, corrections.dipole_lengths, coupler));
  if (corrections.along_membrane || !corrections.dipole_lengths.empty())
    corrections.normals = std::make_unique<coupler::NodeNormals>(the_case.run.threads);
  return corrections;
}

}  // namespace tanktread::driver
