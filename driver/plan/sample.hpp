// The speed of a case that is too large to be tried as a whole.
#pragma once

#include <span>

#include "driver/case/case.hpp"
#include "driver/plan/probe.hpp"
#include "driver/system/shape_source.hpp"
#include "driver/units/units.hpp"

namespace tanktread::driver {

/// A case cut down to the capsule with the most nodes, in the middle of a box of at most 96 nodes along an
/// axis (three times that capsule's length, if it is longer).
/// @param sizes of the meshes of all capsules @param shape_of gives their shapes
Case sample_of(const Case& the_case, std::span<const MeshSize> sizes, const ShapeSource& shape_of);

/// Tries a sample of a case (try_case), and concludes on all of it: n nodes and m membrane nodes take n
/// (seconds a node) + m (seconds a membrane node). What files and rows take is not measured.
/// @param sizes, shape_of as above
Probe try_sample(const Case& the_case, const Parameters& parameters, std::span<const MeshSize> sizes,
                 const ShapeSource& shape_of);

}  // namespace tanktread::driver
