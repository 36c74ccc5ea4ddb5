#include "driver/plan/echo_table.hpp"

#include <fmt/format.h>

#include <sstream>

namespace tanktread::driver {
namespace {

constexpr int columns = 100;
constexpr int name_columns = 24, value_columns = 20, si_columns = 15;

}  // namespace

EchoTable::EchoTable(bool has_si_column) : has_si_column_(has_si_column) {}

void EchoTable::title(const std::string& title) {
  if (!title.empty()) text_ += title + "\n\n";
}

void EchoTable::section(const std::string& name) {
  text_ += name;
  if (!has_heading_ && has_si_column_) {
    text_ += fmt::format("{:<{}}{:<{}}{}", "", 2 + name_columns - static_cast<int>(name.size()),
                         "lattice units", value_columns, "SI");
  }
  has_heading_ = true;
  text_ += '\n';
}

void EchoTable::row(const std::string& name, const std::string& value, const std::string& in_si,
                    const std::string& note, bool is_shown) {
  if (!is_shown) return;
  // A value too long for its column keeps a space from the next.
  text_ += fmt::format("  {:<{}}{:<{}} ", name, name_columns, value, value_columns - 1);
  if (has_si_column_) text_ += fmt::format("{:<{}} ", in_si, si_columns - 1);
  text_ += note;
  text_.erase(text_.find_last_not_of(' ') + 1);
  text_ += '\n';
}

void EchoTable::paragraph(const std::string& text) {
  std::istringstream words(text);
  std::string line;
  for (std::string word; words >> word;) {
    if (!line.empty() && line.size() + 1 + word.size() > columns) {
      text_ += line + '\n';
      line = " ";
    }
    line += (line.empty() ? "" : " ") + word;
  }
  text_ += line + '\n';
}

}  // namespace tanktread::driver
