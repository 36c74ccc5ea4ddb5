// Words of a command line that a message tells the user to give.
#pragma once

#include <filesystem>
#include <string>

namespace tanktread::exchange {

/// A word as a POSIX shell takes it for that one word: as it is, or in single quotes if it holds anything
/// that a shell would read otherwise (a blank, a quote, $, ~ ...).
std::string shell_text(const std::filesystem::path& word);

}  // namespace tanktread::exchange
