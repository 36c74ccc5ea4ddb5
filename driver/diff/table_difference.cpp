#include "driver/diff/table_difference.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <optional>
#include <sstream>

#include "exchange/vtk_files.hpp"

namespace tanktread::driver {
namespace {

struct Table {
  std::vector<std::string> names;
  std::vector<std::vector<std::string>> rows;
  std::vector<std::string> comments;
  std::vector<bool> windows_ends;  ///< of each line
};

constexpr const char* missing_cell = "(no cell)";

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream stream(line);
  for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
  if (line.ends_with(',')) cells.emplace_back();
  return cells;
}

/// As many cells as there are columns: what is too much stays with the last.
std::vector<std::string> cells_of(const std::string& line, std::size_t n_columns) {
  auto cells = cells_of(line);
  while (cells.size() > n_columns && cells.size() > 1) {
    cells[cells.size() - 2] += "," + cells.back();
    cells.pop_back();
  }
  cells.resize(n_columns, missing_cell);
  return cells;
}

Table read_table(const std::filesystem::path& file) {
  std::ifstream stream(file);
  if (!stream) throw exchange::FileError(fmt::format("{}: cannot be read", file.string()));
  Table table;
  bool has_names = false;
  for (std::string line; std::getline(stream, line);) {
    table.windows_ends.push_back(line.ends_with('\r'));
    if (table.windows_ends.back()) line.pop_back();
    if (line.starts_with('#')) {
      table.comments.push_back(line);
    } else if (!has_names) {
      table.names = cells_of(line);
      has_names = true;
    } else {
      table.rows.push_back(cells_of(line, table.names.size()));
    }
  }
  return table;
}

std::vector<std::string> column(const Table& table, std::size_t index, std::size_t n_rows) {
  std::vector<std::string> cells;
  for (std::size_t k = 0; k < n_rows; ++k) cells.push_back(table.rows[k][index]);
  return cells;
}

std::optional<double> number(const std::string& cell) {
  double value = 0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (error != std::errc() || end != cell.data() + cell.size()) return std::nullopt;
  return value;
}

void add_column(const std::string& name, const std::vector<std::string>& a, const std::vector<std::string>& b,
                DifferenceReport& report) {
  std::vector<double> numbers_a(a.size()), numbers_b(a.size());  // 0 where the cells are alike
  std::vector<std::size_t> different;
  bool numeric = true;
  for (std::size_t k = 0; k < a.size(); ++k) {
    if (a[k] == b[k]) continue;
    different.push_back(k);
    const auto x = number(a[k]), y = number(b[k]);
    numeric = numeric && x && y;
    numbers_a[k] = x.value_or(0);
    numbers_b[k] = y.value_or(0);
  }
  auto found = exchange::value_difference("column", name, 1, numbers_a, numbers_b);
  found.n_different = static_cast<std::int64_t>(different.size());
  if (different.empty()) return report.add(found, {});
  const auto first = different.front();
  found.first = static_cast<std::int64_t>(first);
  if (found.max == 0) found.largest = found.first;
  if (!numeric) {
    found.problem =
        fmt::format("{} of {} values, not all of them numbers; first at row {}: '{}' against '{}'",
                    different.size(), a.size(), first + 1, a[first], b[first]);
  }
  report.add(found, {[](std::int64_t row) { return fmt::format("row {}", row + 1); }, a[first], b[first]});
}

/// What another program makes of a table that it saves again.
void compare_line_ends(const Table& a, const Table& b, DifferenceReport& report) {
  const auto n = static_cast<std::ptrdiff_t>(std::min(a.windows_ends.size(), b.windows_ends.size()));
  if (std::equal(a.windows_ends.begin(), a.windows_ends.begin() + n, b.windows_ends.begin())) return;
  report.add(fmt::format("{} lines with Windows line ends against {}",
                         std::ranges::count(a.windows_ends, true), std::ranges::count(b.windows_ends, true)));
}

void add_lonely_column(const std::string& name, const char* where, DifferenceReport& report) {
  exchange::ArrayDifference found;
  found.kind = "column";
  found.name = name;
  found.problem = where;
  report.add(found, {});
}

/// Where the column stands in the other table; by number if all names are the same, as a name may stand there
/// twice.
std::optional<std::size_t> same_column(const Table& table, std::size_t index, const Table& other) {
  if (table.names == other.names) return index;
  const auto found = std::find(other.names.begin(), other.names.end(), table.names[index]);
  if (found == other.names.end()) return std::nullopt;
  return static_cast<std::size_t>(found - other.names.begin());
}

}  // namespace

void compare_tables(const std::filesystem::path& file_a, const std::filesystem::path& file_b,
                    DifferenceReport& report) {
  const auto a = read_table(file_a), b = read_table(file_b);
  const auto n_rows = std::min(a.rows.size(), b.rows.size());
  compare_line_ends(a, b, report);
  if (a.comments != b.comments) report.add("the comment lines differ");
  if (a.rows.size() != b.rows.size()) {
    report.add(
        fmt::format("{} rows against {}; the first {} are compared", a.rows.size(), b.rows.size(), n_rows));
  }
  for (std::size_t k = 0; k < a.names.size(); ++k) {
    const auto other = same_column(a, k, b);
    if (other) {
      add_column(a.names[k], column(a, k, n_rows), column(b, *other, n_rows), report);
    } else {
      add_lonely_column(a.names[k], "only in the first", report);
    }
  }
  for (std::size_t k = 0; k < b.names.size(); ++k) {
    if (!same_column(b, k, a)) add_lonely_column(b.names[k], "only in the second", report);
  }
}

}  // namespace tanktread::driver
