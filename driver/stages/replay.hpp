// A component at work again on what a run recorded.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "exchange/difference.hpp"

namespace tanktread::driver {

/// What `tanktread replay` was told.
struct ReplayOptions {
  std::filesystem::path record;          ///< the directory of `tanktread run --record`
  std::string component;                 ///< membrane | implicit | coupler | fluid
  std::vector<std::string> assignments;  ///< settings that differ from those recorded
  std::filesystem::path out;  ///< a new directory for the differences as fields; "": none are written
};

/// How an array that the component gave differs from the recorded one.
struct ReplayedArray {
  std::int64_t step = 0;  ///< that the packet is of
  std::string packet;     ///< node_force ..., or end for the state after the last step
  std::filesystem::path file;
  exchange::ArrayDifference difference;  ///< a: recorded, b: given now
};

/// Feeds a component the recorded inputs of each step and compares what it gives with what was recorded. Its
/// own state (history, populations) is its own from the first step on: that recorded at the beginning.
/// - membrane: node_velocity and the positions before it -> positions; positions -> node_force; its history
/// at
///   the end
/// - implicit: what membrane and coupler find together for an implicit viscosity: positions, explicit_force,
///   free_velocity -> node_force; all histories at the end. Then the membrane gives explicit_force in the
///   place of node_force, its history is not compared, and the fluid gives free_velocity too
/// - coupler: positions, grid_velocity (and with coupler.tangential_correction the node_force before) ->
///   node_velocity; positions, node_force -> grid_force; with a viscosity contrast
///   positions -> inside
/// - fluid: grid_force (and inside) -> grid_velocity of the next step; its whole state at the end
/// @return all arrays, in the order of the steps
/// @throws InputError for a record that is not there, incomplete or does not fit the settings; RunError
std::vector<ReplayedArray> replay(const ReplayOptions& options);

}  // namespace tanktread::driver
