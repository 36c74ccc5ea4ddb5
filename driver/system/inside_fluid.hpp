// Which nodes of the grid are inside which capsule: what the viscosity of the fluid goes by.
#pragma once

#include <memory>
#include <vector>

#include "coupler/inside.hpp"
#include "driver/case/case.hpp"
#include "driver/packets/packets.hpp"

namespace tanktread::driver {

/// The marks of a case's grid, all 0 so far; null if the fluid has the same viscosity everywhere.
std::unique_ptr<coupler::InsideMarks> make_inside(const Case& the_case);

/// coupler: marks the nodes that are inside the surfaces. @param anew all nodes are looked at; else those
/// that surfaces may have passed since the last call (InsideMarks::update)
/// @return the nodes whose mark is another than before
/// @throws coupler::InsideError
GridMarks mark_inside(coupler::InsideMarks& marks, const NodeVectors& positions,
                      const std::vector<Eigen::Matrix3Xi>& triangles, bool anew = false);

}  // namespace tanktread::driver
