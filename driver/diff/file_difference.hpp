// Two outputs compared: files, or directories of them.
#pragma once

#include <filesystem>

#include "driver/diff/difference_report.hpp"

namespace tanktread::driver {

/// Compares two files or two directories. By the ending of their names files are
/// - .vtu, .vti: compared array by array, bit for bit (packet_difference.hpp); so are .pvtu and .pvti, as
///   what their pieces are together, of which one may be whole and the other in pieces;
/// - .pvd: the names and times of the series, then the files that it names;
/// - .csv: column by column (table_difference.hpp);
/// - any other: byte by byte.
/// Directories: the files of the same relative path; a series there is compared without its files, which have
/// their turn anyway. Names that begin with a dot (.lock, what is being written) are left out.
/// @throws InputError if something is missing, cannot be read, or is not of one kind with the other
DifferenceReport compare_outputs(const std::filesystem::path& a, const std::filesystem::path& b,
                                 const DifferenceOptions& options);

}  // namespace tanktread::driver
