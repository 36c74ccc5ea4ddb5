#include "driver/stages/state_case.hpp"

#include <fmt/format.h>

#include <cstdio>

#include "driver/case/case_difference.hpp"
#include "driver/packets/saved_state.hpp"

namespace tanktread::driver {

void note_other_case(const std::filesystem::path& state, const Case& the_case, const std::string& table) {
  const auto made_it = read_state_case(std::filesystem::absolute(state).parent_path());
  if (!made_it) return;
  auto found = differences(*made_it, the_case);
  std::erase_if(found, [&](const KeyDifference& d) { return !d.path.starts_with(table); });
  const auto lines = lines_of_fixed_keys(found, "the case that made it", "this one");
  if (!lines.empty())
    fmt::print(stderr, "note: {} was made with other settings:\n{}\n", state.string(), lines);
}

}  // namespace tanktread::driver
