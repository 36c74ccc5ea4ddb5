// Small inputs of our own that fuzzers start from: what the program writes, and what other programs write.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tanktread::fuzz {

/// Whole inputs of a target (targets.hpp).
std::vector<std::string> seeds(const std::string& target);

/// Writes the pieces that the seeds of surface_index and of grid_index name, by paths relative to the folder.
void write_pieces(const std::filesystem::path& folder);

/// Words of a target's language, which a fuzzer puts in and swaps.
std::vector<std::string> words(const std::string& target);

}  // namespace tanktread::fuzz
