#include "driver/case/case_difference.hpp"

#include <fmt/format.h>

#include "driver/case/said_value.hpp"

namespace tanktread::driver {
namespace {

std::string text_of(const Value& value) {
  return is_given(value) ? toml_text(value) : "not given";
}

/// Compares one key of one capsule. @param path to name it by
void compare(std::vector<KeyDifference>& found, const Key& key, const std::string& path, const Case& first,
             const Case& second, std::size_t capsule) {
  const auto a = said_value(key, first, capsule), b = said_value(key, second, capsule);
  if (a != b) found.push_back({&key, path, text_of(a), text_of(b)});
}

/// The key of [membrane] that a capsule's own key overrides; null: none.
const Key* key_above(const Key& key) {
  const std::string own = "capsule.N.";
  return key.path.starts_with(own + "membrane.") ? find_key(key.path.substr(own.size())) : nullptr;
}

bool is_shared_in_both(const Key& key, const Case& first, const Case& second) {
  return is_shared(key, first) && is_shared(key, second);
}

void compare_in_capsules(std::vector<KeyDifference>& found, const Key& key, const Case& first,
                         const Case& second) {
  const auto* above = key_above(key);
  if (above != nullptr && is_shared_in_both(*above, first, second)) return;  // is said there
  for (std::size_t k = 0; k < first.capsules.size(); ++k)
    compare(found, key, numbered_path(key.path, k), first, second, k);
}

}  // namespace

std::vector<KeyDifference> differences(const Case& first, const Case& second) {
  if (first.capsules.size() != second.capsules.size()) {
    return {{nullptr, "[[capsule]]", fmt::format("{}", first.capsules.size()),
             fmt::format("{}", second.capsules.size())}};
  }
  std::vector<KeyDifference> found;
  for (const auto& key : schema()) {
    if (is_capsule_key(key)) {
      compare_in_capsules(found, key, first, second);
    } else if (!is_membrane_key(key) || is_shared_in_both(key, first, second)) {
      compare(found, key, key.path, first, second, 0);
    }
  }
  return found;
}

std::string lines_of_fixed_keys(const std::vector<KeyDifference>& differences, const std::string& first,
                                const std::string& second) {
  std::string lines;
  for (const auto& d : differences) {
    if (d.key != nullptr && d.key->may_change_on_resume) continue;
    lines += fmt::format("{}  {}: {} in {}, {} in {}", lines.empty() ? "" : "\n", d.path, d.first, first,
                         d.second, second);
  }
  return lines;
}

}  // namespace tanktread::driver
