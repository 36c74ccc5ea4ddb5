// The speed of a case that is too large to be tried as a whole.
#pragma once

#include <vector>

#include "driver/case/case.hpp"
#include "driver/plan/probe.hpp"
#include "driver/units/units.hpp"
#include "membrane/mesh.hpp"

namespace tanktread::driver {

/// A case cut down to the capsule with the most nodes, in the middle of a box of at most 96 nodes along an
/// axis (three times that capsule's length, if it is longer).
Case sample_of(const Case& the_case, const std::vector<membrane::TriangleMesh>& meshes);

/// Tries a sample of a case (try_case), and concludes on all of it: n nodes and m membrane nodes take n
/// (seconds a node) + m (seconds a membrane node). What files and rows take is not measured.
/// @param meshes of all capsules
Probe try_sample(const Case& the_case, const Parameters& parameters,
                 const std::vector<membrane::TriangleMesh>& meshes);

}  // namespace tanktread::driver
