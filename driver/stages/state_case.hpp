// A stage that goes on from the state of a run: which settings are no longer those that made it.
#pragma once

#include <filesystem>
#include <string>

#include "driver/case/case.hpp"

namespace tanktread::driver {

/// Prints a line to stderr for each key that the case has otherwise than the one beside the state, which a
/// checkpoint and a record have. To go on with other settings is what a stage may be for, but is said. A
/// state by itself (an output of a stage) has no case, and nothing is compared.
/// @param table of the keys that matter to the stage, "flow."; "": all
/// @throws exchange::FileError if there is a case that cannot be read
void note_other_case(const std::filesystem::path& state, const Case& the_case, const std::string& table);

}  // namespace tanktread::driver
