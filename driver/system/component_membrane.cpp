#include <fmt/format.h>

#include "driver/system/components.hpp"
#include "driver/system/loads.hpp"
#include "driver/units/laws.hpp"
#include "membrane/viscous_law.hpp"

namespace tanktread::driver {

std::vector<CapsuleMembrane> make_membranes(const Case& the_case, const Parameters& parameters,
                                            const MembraneShapes& shapes) {
  const auto& meshes = shapes.meshes;
  if (meshes.size() != the_case.capsules.size()) {
    throw InputError(
        fmt::format("{}: {} capsules, but there are meshes of {}: the state and the case do not fit",
                    the_case.file.string(), the_case.capsules.size(), meshes.size()));
  }
  std::vector<CapsuleMembrane> membranes;
  for (std::size_t k = 0; k < meshes.size(); ++k) {
    const bool has_program = !the_case.capsules[k].membrane.command.empty();
    membrane::Membrane membrane(
        shapes.reference(k), elastic_law(the_case.capsules[k].membrane, parameters.capsules[k]),
        has_program ? nullptr : viscous_law(parameters.capsules[k]), the_case.run.threads);
    membrane.begin_at(meshes[k].points);
    if (!has_program)
      membrane.set_energy_terms(energy_terms(the_case.capsules[k].membrane, parameters.capsules[k], meshes[k],
                                             the_case.run.threads));
    membranes.emplace_back(
        std::move(membrane),
        has_program ? std::make_unique<OutsideMembrane>(the_case, parameters, k) : nullptr,
        has_program ? nullptr : implicit_viscosity(parameters.capsules[k], meshes[k], the_case.run.threads));
  }
  add_loads(membranes, the_case, parameters, meshes);
  return membranes;
}

}  // namespace tanktread::driver
