// The components of a case, each made by itself.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "coupler/coupler.hpp"
#include "driver/case/case.hpp"
#include "driver/system/capsule_membrane.hpp"
#include "driver/system/node_corrections.hpp"
#include "driver/units/units.hpp"
#include "fluid/fluid.hpp"
#include "fluid/lattice_boltzmann.hpp"

namespace tanktread::driver {

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

/// The stress-free mesh of a capsule, and the hash of the file that it was made of ("": of none).
struct ReferenceMesh {
  membrane::TriangleMesh mesh;
  std::string file_hash;
};

/// The stress-free mesh of a capsule at its place in the box: a sphere by its level, or a file scaled to the
/// radius by its volume. @throws InputError if the file is not a surface that can be a membrane, or the
/// state of a deformed one, or has another hash than the case says
ReferenceMesh reference_mesh(const Case& the_case, std::size_t capsule);
/// Those of all capsules. @throws InputError also if one of them has no room (check_placement)
std::vector<membrane::TriangleMesh> reference_meshes(const Case& the_case);

/// What a user should know of the files that meshes are from, a sentence each: the file is of a run, at a
/// time after its start. @throws InputError if one cannot be read
std::vector<std::string> remarks_on_mesh_files(const Case& the_case);

/// The membranes of a case at rest, with their loads. @param meshes the reference mesh of each capsule
/// @throws InputError if a program in the place of a membrane cannot be started
std::vector<CapsuleMembrane> make_membranes(const Case& the_case, const Parameters& parameters,
                                            const std::vector<membrane::TriangleMesh>& meshes);

}  // namespace tanktread::driver
