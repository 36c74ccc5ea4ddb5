// Two cases, key by key: in what a state's case differs from the one that is to go on with it.
#pragma once

#include <string>
#include <vector>

#include "driver/case/schema.hpp"

namespace tanktread::driver {

/// A key whose value is not the same in two cases.
struct KeyDifference {
  const Key* key = nullptr;   ///< null: the number of capsules
  std::string path;           ///< with the capsule's number, as a file would say it
  std::string first, second;  ///< the values as they stand in a file, or "not given"
};

/// Every key of the schema that differs, in the order of the manual. A key of [membrane] that all capsules
/// share in both cases is named once. With unequal numbers of capsules only that is said.
std::vector<KeyDifference> differences(const Case& first, const Case& second);

/// Those among them that a run cannot go on with (Key::may_change_on_resume is false), a line each: "KEY:
/// VALUE in FIRST, VALUE in SECOND". @return "" if there are none
std::string lines_of_fixed_keys(const std::vector<KeyDifference>& differences, const std::string& first,
                                const std::string& second);

}  // namespace tanktread::driver
