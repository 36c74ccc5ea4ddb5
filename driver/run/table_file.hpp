// A table of a run as a file that a resumed run goes on with: read, checked, cut.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace tanktread::driver {

/// A row of the table: its time step, and its text with the line end.
struct TableRow {
  std::int64_t step = 0;
  std::string text;
};

/// The rows of a table that this program has written; half a row at the end, which a killed process leaves,
/// is left out.
/// @param header that the table must have, with its line end
/// @throws exchange::FileError for a file that is not there, has other line ends or another header, or a line
/// that is no row of it; the message says which, and the fix
std::vector<TableRow> read_table(const std::filesystem::path& file, const std::string& header);

/// Writes the header and these rows. @throws exchange::FileError
void write_table(const std::filesystem::path& file, const std::string& header,
                 const std::vector<TableRow>& rows);

}  // namespace tanktread::driver
