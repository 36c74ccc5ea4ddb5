// "Did you mean": the nearest known word to one that is not known.
#pragma once

#include <string>
#include <vector>

namespace tanktread::driver {

/// The candidate nearest in spelling to `word`, or "". Distance is the least number of letters changed, put
/// in or left out, or neighbours swapped (capital or small is no difference); at most a third of the word's
/// length counts as near, but one letter always does.
std::string nearest_spelling(const std::string& word, const std::vector<std::string>& candidates);

}  // namespace tanktread::driver
