// The state of a case at work to a folder, and back.
#pragma once

#include <filesystem>

#include "driver/packets/saved_state.hpp"
#include "driver/system/surface_files.hpp"
#include "driver/system/system.hpp"

namespace tanktread::driver {

/// Makes the folder and writes the state of a system into it, with the case that made it.
/// @throws exchange::FileError
void write_state(const std::filesystem::path& folder, const System& system, const Case& the_case,
                 FileSizes sizes = FileSizes::whole);

/// Sets a freshly made system to a state. @throws InputError if it does not fit the case;
/// exchange::FileError if the fluid's is in pieces, and one cannot be read
void restore(System& system, const SavedState& state);

}  // namespace tanktread::driver
