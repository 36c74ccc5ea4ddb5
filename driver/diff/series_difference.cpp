#include "driver/diff/series_difference.hpp"

#include <fmt/format.h>

#include <set>
#include <string_view>

namespace tanktread::driver {
namespace {

using Entries = std::vector<exchange::SeriesEntry>;

std::set<std::string> names_of(const Entries& entries) {
  std::set<std::string> names;
  for (const auto& entry : entries) names.insert(whole_name(entry.file));
  return names;
}

/// The entries whose files are, or are not, among `names`.
Entries those(const Entries& entries, const std::set<std::string>& names, bool among) {
  Entries chosen;
  for (const auto& entry : entries) {
    if (names.contains(whole_name(entry.file)) == among) chosen.push_back(entry);
  }
  return chosen;
}

void add_lonely(const Entries& entries, const char* where, DifferenceReport& report) {
  if (entries.empty()) return;
  const auto& first = entries.front().file;
  report.add(entries.size() == 1 ? fmt::format("an entry only in {}: '{}'", where, first)
                                 : fmt::format("{} entries only in {}, the first of them '{}'",
                                               entries.size(), where, first));
}

bool same_files(const Entries& a, const Entries& b) {
  if (a.size() != b.size()) return false;
  for (std::size_t k = 0; k < a.size(); ++k) {
    if (whole_name(a[k].file) != whole_name(b[k].file)) return false;
  }
  return true;
}

}  // namespace

std::string whole_name(const std::string& file) {
  for (const std::string_view of_index : {".pvti", ".pvtu"}) {
    if (!file.ends_with(of_index)) continue;
    // Without the p, which says that it is in pieces.
    return file.substr(0, file.size() - of_index.size()) + "." + std::string(of_index.substr(2));
  }
  return file;
}

void compare_series(const Entries& a, const Entries& b, DifferenceReport& report) {
  const auto names_a = names_of(a), names_b = names_of(b);
  add_lonely(those(a, names_b, false), "the first", report);
  add_lonely(those(b, names_a, false), "the second", report);
  const auto common_a = those(a, names_b, true), common_b = those(b, names_a, true);
  if (!same_files(common_a, common_b)) {
    return report.add(
        "the files that both name stand in another order, or one of them at more times in one than in the "
        "other");
  }
  std::vector<double> times_a, times_b;
  for (const auto& entry : common_a) times_a.push_back(entry.time);
  for (const auto& entry : common_b) times_b.push_back(entry.time);
  report.add(exchange::value_difference("series", "times", 1, times_a, times_b),
             {[&](std::int64_t k) {
                return fmt::format("entry {} ({})", k, common_a[static_cast<std::size_t>(k)].file);
              },
              {},
              {}});
}

}  // namespace tanktread::driver
