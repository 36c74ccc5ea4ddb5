#include "driver/case/key_depth.hpp"

#include <cctype>

namespace tanktread::driver {
namespace {

/// Where the text that begins with a quote at `first` ends: the place after its last quote, or the end of
/// all.
std::size_t end_of_text(std::string_view toml, std::size_t first) {
  const auto quote = toml[first];
  const auto three = quote == '"' ? std::string_view("\"\"\"") : std::string_view("'''");
  const auto ending = toml.substr(first).starts_with(three) ? three : three.substr(0, 1);
  for (auto at = first + ending.size(); at < toml.size(); ++at) {
    if (toml[at] == '\\' && quote == '"') {
      ++at;
    } else if (ending.size() == 1 && toml[at] == '\n') {
      return at;  // a text of one quote ends with its line at the latest
    } else if (toml.substr(at).starts_with(ending)) {
      return at + ending.size();
    }
  }
  return toml.size();
}

/// A character that may stand in a name without quotes, or around the dots between names.
bool continues_name(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-' || c == ' ' || c == '\t';
}

}  // namespace

std::optional<int> line_of_deep_key(std::string_view toml) {
  int line = 1, n_parts = 1;
  for (std::size_t at = 0; at < toml.size();) {
    const char c = toml[at];
    auto next = at + 1;
    if (c == '"' || c == '\'') {
      next = end_of_text(toml, at);
      for (const char within : toml.substr(at, next - at)) line += within == '\n' ? 1 : 0;
    } else if (c == '#') {
      next = toml.find('\n', at);
      if (next == std::string_view::npos) break;
    } else if (c == '.') {
      if (++n_parts > most_key_parts) return line;
    } else if (!continues_name(c)) {
      n_parts = 1;
      if (c == '\n') ++line;
    }
    at = next;
  }
  return std::nullopt;
}

}  // namespace tanktread::driver
