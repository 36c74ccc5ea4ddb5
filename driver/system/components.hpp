// The components of a case, each made by itself.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "coupler/coupler.hpp"
#include "driver/case/case.hpp"
#include "driver/packets/membrane_shapes.hpp"
#include "driver/system/capsule_membrane.hpp"
#include "driver/system/node_corrections.hpp"
#include "driver/units/units.hpp"
#include "fluid/fluid.hpp"
#include "fluid/lattice_boltzmann.hpp"

namespace tanktread::driver {

/// The settings of the flow solver of a case.
fluid::LatticeBoltzmannSettings fluid_settings(const Case& the_case, const FlowParameters& parameters);

/// The flow solver of a case, at its start. @throws InputError if it is a program that cannot be started
std::unique_ptr<fluid::Fluid> make_fluid(const Case& the_case, const FlowParameters& parameters);

/// The precision in which the case has its fluid kept (flow.storage).
fluid::Storage storage_of(const FlowCase& flow);

/// Memory of the flow solver and of its state beside it, as when a checkpoint is written.
double fluid_memory_bytes(const FlowCase& flow);

/// The grid of a case as the coupler sees it.
coupler::Grid coupler_grid(const Case& the_case);
/// The coupler of a case, without stencils.
std::unique_ptr<coupler::Coupler> make_coupler(const Case& the_case);
/// What a case adds to the velocity that its coupler interpolates.
NodeCorrections make_node_corrections(const Case& the_case, const coupler::Coupler& coupler);

/// The membranes of a case at its start: where the meshes are, at rest, with their loads. @param shapes one
/// each a capsule
/// @throws InputError if a program in the place of a membrane cannot be started
std::vector<CapsuleMembrane> make_membranes(const Case& the_case, const Parameters& parameters,
                                            const MembraneShapes& shapes);

}  // namespace tanktread::driver
