// The table of keys in its groups. Internal to the schema.
#pragma once

#include "driver/case/schema.hpp"

namespace tanktread::driver {

/// So that the number of all nodes is an integer of 64 bits; memory ends long before.
inline constexpr int most_nodes_along_axis = 100'000;

std::vector<Key> title_and_flow_keys();
std::vector<Key> capsule_keys();
/// The keys of a membrane, under "membrane." or, to override them, "capsule.N.membrane.".
std::vector<Key> membrane_keys(const std::string& prefix);
std::vector<Key> coupler_run_output_keys();
std::vector<Key> si_keys();

}  // namespace tanktread::driver
