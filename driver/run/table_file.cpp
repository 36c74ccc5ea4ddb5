#include "driver/run/table_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <fstream>

#include "exchange/shell_text.hpp"
#include "exchange/vtk_files.hpp"

namespace tanktread::driver {
namespace {

/// Why the first line is not the table's header.
std::string header_fault(const std::filesystem::path& file, const std::string& line,
                         const std::string& header) {
  if (line + "\n" == header) return "";
  if (line + "\n" == header.substr(0, header.size() - 1) + "\r\n") {
    return fmt::format(
        "has Windows line ends, so another program has written it; remove them, for example with "
        "sed -i 's/\\r$//' {}",
        exchange::shell_text(file));
  }
  return "has another header than this program writes; put the run's own table there";
}

/// The step of a row; -1 if it is no row.
std::int64_t step_of_row(const std::string& line, const std::string& header) {
  std::int64_t step = -1;
  const auto [end, error] = std::from_chars(line.data(), line.data() + line.size(), step);
  const bool has_all_cells = std::ranges::count(line, ',') == std::ranges::count(header, ',') &&
                             !line.ends_with(',') && !line.ends_with('\r');
  return error == std::errc() && *end == ',' && has_all_cells ? step : -1;
}

}  // namespace

std::vector<TableRow> read_table(const std::filesystem::path& file, const std::string& header) {
  std::ifstream input(file, std::ios::binary);
  std::string line;
  if (!input || !std::getline(input, line))
    throw exchange::FileError(fmt::format("{}: is missing, empty or cannot be read", file.string()));
  const auto fault = header_fault(file, line, header);
  if (!fault.empty()) throw exchange::FileError(fmt::format("{}: {}", file.string(), fault));
  std::vector<TableRow> rows;
  while (std::getline(input, line) && !input.eof()) {  // without its line end a row is not whole
    const auto step = step_of_row(line, header);
    if (step < 0 || (!rows.empty() && step < rows.back().step)) {
      throw exchange::FileError(
          fmt::format("{}: line {} is no row of the table; put the run's own table there", file.string(),
                      rows.size() + 2));
    }
    rows.push_back({step, line + "\n"});
  }
  return rows;
}

void write_table(const std::filesystem::path& file, const std::string& header,
                 const std::vector<TableRow>& rows) {
  auto text = header;
  for (const auto& row : rows) text += row.text;
  exchange::write_text(file, text);
}

}  // namespace tanktread::driver
