// What an echo of a case says: the value of each key that has a place in it.
#pragma once

#include <cstddef>

#include "driver/case/schema.hpp"

namespace tanktread::driver {

/// Whether the key has a place in such a case (Key::objection).
bool has_place(const Key& key, const Case& the_case, std::size_t capsule);

/// The key's value as an echo of the case says it; nothing where it has none, or no place.
Value said_value(const Key& key, const Case& the_case, std::size_t capsule);

/// Whether a key of [membrane] has a place in each capsule, with the same value: it is then said once, so
/// that changing it there changes all capsules.
bool is_shared(const Key& key, const Case& the_case);

}  // namespace tanktread::driver
