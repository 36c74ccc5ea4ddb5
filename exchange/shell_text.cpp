#include "exchange/shell_text.hpp"

namespace tanktread::exchange {

std::string shell_text(const std::filesystem::path& word) {
  const auto& text = word.native();
  const char* harmless = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=./,:@%";
  if (!text.empty() && text.find_first_not_of(harmless) == std::string::npos) return text;
  std::string quoted = "'";
  for (const char character : text) {
    if (character == '\'') {
      quoted += R"('\'')";  // ends the quotes, a quote by itself, begins them again
    } else {
      quoted += character;
    }
  }
  return quoted + "'";
}

}  // namespace tanktread::exchange
