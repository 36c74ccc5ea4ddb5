// The rows of the echo on the load of a capsule.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "driver/plan/echo_subject.hpp"
#include "driver/plan/echo_table.hpp"
#include "membrane/end_loads.hpp"

namespace tanktread::driver {

/// The patches of each capsule's load; none without a load.
using LoadPatches = std::vector<std::optional<membrane::EndPatches>>;

/// @param start the mesh that the capsule starts as
std::optional<membrane::EndPatches> load_patches_of(const CapsuleCase& capsule,
                                                    const membrane::TriangleMesh& start);

/// Nothing without a load. @param patches of the capsule; none: not known, and left out
void put_load(EchoTable& table, const Subject& subject, std::size_t number_of_it,
              const std::optional<membrane::EndPatches>& patches);

}  // namespace tanktread::driver
