// The last lines of a run: where it ended, where its time went, what bounds it.
#pragma once

#include <filesystem>
#include <string>

#include "driver/run/progress.hpp"
#include "driver/system/system.hpp"

namespace tanktread::driver {

/// A row for each account of the time, with its share of the whole; what is in none is the last, "else".
/// @param files seconds that output and checkpoints took
/// @param whole seconds from the first step to the end
std::string time_table(const StepSeconds& steps, double files, double whole);

/// How near the fluid's step came to the speed of memory: "" where there is no such bound to tell.
/// @param bytes_a_second that the step moved at the least
/// @param of_memory the speed of an update in place, measured beside it
std::string bound_line(double bytes_a_second, double of_memory);

/// Prints all that, and at the end "ended at step N with X MLUPS; ...", of the whole run. Memory is measured
/// for 0.3 s at most, and only after a run of some seconds that no signal ended.
/// @param step that it ended at @param seconds of its steps @param files as above
void print_closing(std::int64_t step, const StepSeconds& seconds, const Case& the_case,
                   const Progress& progress, double files, const std::filesystem::path& directory);

}  // namespace tanktread::driver
