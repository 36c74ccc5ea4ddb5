// Writes the seeds of a target, a file each, and its words as a dictionary: write_seeds TARGET FOLDER
// DICTIONARY.
#include <fmt/format.h>

#include <cstdio>
#include <string>

#include "tests/fuzz/input_file.hpp"
#include "tests/fuzz/seeds.hpp"

namespace {

/// As libFuzzer's dictionaries have it: in quotes, with a backslash before quotes and backslashes.
std::string quoted(const std::string& word) {
  std::string text = "\"";
  for (const char c : word) {
    if (c == '"' || c == '\\') text += '\\';
    // Other characters than printable ones in hexadecimal digits.
    if (c >= ' ' && c <= '~') {
      text += c;
    } else {
      text += fmt::format("\\x{:02x}", static_cast<unsigned char>(c));
    }
  }
  return text + "\"\n";
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) {
    std::fputs("write_seeds TARGET FOLDER DICTIONARY\n", stderr);
    return 2;
  }
  const std::filesystem::path folder = argv[2];
  int number = 0;
  for (const auto& seed : tanktread::fuzz::seeds(argv[1]))
    tanktread::fuzz::put_bytes(folder / ("seed" + std::to_string(number++)), seed);
  std::string dictionary;
  for (const auto& word : tanktread::fuzz::words(argv[1])) dictionary += quoted(word);
  tanktread::fuzz::put_bytes(argv[3], dictionary);
}
