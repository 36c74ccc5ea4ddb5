// From a node of a TOML document to a value of the kind and in the range that a key allows.
#pragma once

#include <toml++/toml.h>

#include <string>

#include "driver/case/schema.hpp"

namespace tanktread::driver {

/// The value, or nothing if the node does not hold what the key allows. An integer will do for a real number,
/// not the other way.
Value value_of(const toml::node& node, const Key& key);

/// The node as it would stand in a file, on one line.
std::string node_text(const toml::node& node);

}  // namespace tanktread::driver
