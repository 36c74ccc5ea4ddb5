// What a membrane needs besides its positions to go on.
#pragma once

#include <vector>

#include "exchange/packet.hpp"

namespace tanktread::driver {

/// Arrays on the points and on the triangles of a surface.
struct SurfaceArrays {
  std::vector<exchange::Array> point_data, cell_data;
};

/// What a membrane needs besides its positions to go on.
struct MembraneState {
  /// membrane::Membrane::history(), then what ImplicitViscosity::append_to() lists.
  std::vector<double> history;
  SurfaceArrays program;  ///< OutsideMembrane::state(); empty without a program
};

}  // namespace tanktread::driver
