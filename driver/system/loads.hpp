// Loads on the membranes of a case (docs/loads.md).
#pragma once

#include <cstdint>
#include <vector>

#include "driver/case/case.hpp"
#include "driver/system/capsule_membrane.hpp"
#include "driver/units/units.hpp"
#include "membrane/end_loads.hpp"

namespace tanktread::driver {

/// Whether a capsule has a load.
bool has_load(const CapsuleCase& capsule);

/// The patches of nodes that the load of a capsule is on. @param start the mesh that the capsule starts as
membrane::EndPatches load_patches(const LoadCase& load, const membrane::TriangleMesh& start);

/// Gives the membranes the loads of their capsules. @param starts the meshes that they start as
void add_loads(std::vector<CapsuleMembrane>& membranes, const Case& the_case, const Parameters& parameters,
               const std::vector<membrane::TriangleMesh>& starts);

}  // namespace tanktread::driver
