// The fluid of a case as a file: what a person looks at, and the state that the solver goes on from.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "driver/case/case_value.hpp"
#include "exchange/packet.hpp"
#include "fluid/fluid.hpp"

namespace tanktread::driver {

/// Density, velocity and force of the nodes in `part`, of all without it; field data step, schema_version,
/// shear_time.
/// @param inside marks of all nodes (coupler::InsideMarks), to be shown too; empty: none
exchange::GridPacket flow_file(const fluid::Fluid& fluid, const std::optional<Ranges3>& part,
                               std::int64_t step, double shear_time,
                               std::span<const std::int32_t> inside = {});

/// The whole state of a solver, for going on bit for bit: its own arrays, field data step, schema_version.
exchange::GridPacket state_file(fluid::State state, const fluid::GridShape& shape);

}  // namespace tanktread::driver
