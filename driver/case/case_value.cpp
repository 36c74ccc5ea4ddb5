#include "driver/case/case_value.hpp"

#include <fmt/format.h>

namespace tanktread::driver {
namespace {

std::string text_of(std::monostate) {
  return "";
}

std::string text_of(bool value) {
  return value ? "true" : "false";
}

std::string text_of(int value) {
  return fmt::format("{}", value);
}

std::string text_of(double value) {
  auto text = fmt::format("{}", value);
  if (text.find_first_of(".en") == std::string::npos) text += ".0";
  return text;
}

/// A basic string of TOML 1.0: on one line, everything special escaped.
std::string text_of(const std::string& value) {
  std::string text = "\"";
  for (const char character : value) {
    const auto code = static_cast<unsigned char>(character);
    if (character == '"' || character == '\\') {
      text += '\\';
      text += character;
    } else if (code < 0x20 || code == 0x7f) {
      text += fmt::format("\\u{:04x}", code);
    } else {
      text += character;
    }
  }
  return text + '"';
}

template <typename Element, std::size_t n>
std::string text_of(const std::array<Element, n>& values);

template <typename List>
std::string list_text(const List& values) {
  std::string text;
  for (const auto& value : values) text += (text.empty() ? "" : ", ") + text_of(value);
  return "[" + text + "]";
}

std::string text_of(const std::vector<std::string>& values) {
  return list_text(values);
}

template <typename Element, std::size_t n>
std::string text_of(const std::array<Element, n>& values) {
  return list_text(values);
}

}  // namespace

std::string toml_text(const Value& value) {
  return std::visit([](const auto& held) { return text_of(held); }, value);
}

}  // namespace tanktread::driver
