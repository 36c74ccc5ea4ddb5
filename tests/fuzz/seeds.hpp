// Small inputs of our own that fuzzers start from: what the program writes, and what other programs write.
#pragma once

#include <string>
#include <vector>

namespace tanktread::fuzz {

/// Whole inputs of a target (targets.hpp).
std::vector<std::string> seeds(const std::string& target);

/// Words of a target's language, which a fuzzer puts in and swaps.
std::vector<std::string> words(const std::string& target);

}  // namespace tanktread::fuzz
