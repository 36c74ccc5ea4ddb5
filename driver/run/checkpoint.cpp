#include "driver/run/checkpoint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <string>

#include "driver/program/errors.hpp"
#include "driver/run/row_counts.hpp"

namespace tanktread::driver {
namespace {

namespace fs = std::filesystem;

const std::string in_use = "step_", set_aside = "set_aside_";

fs::path place_of(const fs::path& directory) {
  return directory / "checkpoints";
}

fs::path folder_of(const fs::path& directory, const std::string& prefix, std::int64_t step) {
  return place_of(directory) / fmt::format("{}{:010}", prefix, step);
}

/// The step in a folder's name after the prefix; none: it is not of that name.
std::optional<std::int64_t> step_in(const fs::path& folder, const std::string& prefix) {
  const auto name = folder.filename().string();
  if (!name.starts_with(prefix)) return std::nullopt;
  std::int64_t step = 0;
  const auto* end = name.data() + name.size();
  const auto [stop, error] = std::from_chars(name.data() + prefix.size(), end, step);
  return error == std::errc() && stop == end ? std::optional(step) : std::nullopt;
}

std::int64_t step_in(const fs::path& folder) {
  const auto step = step_in(folder, in_use);
  return step ? *step : step_in(folder, set_aside).value_or(-1);
}

/// Oldest first.
std::vector<fs::path> folders_named(const fs::path& directory, const std::string& prefix) {
  std::vector<fs::path> folders;
  if (!fs::is_directory(place_of(directory))) return folders;
  for (const auto& entry : fs::directory_iterator(place_of(directory))) {
    if (step_in(entry.path(), prefix)) folders.push_back(entry.path());
  }
  std::ranges::sort(folders, {}, [&](const fs::path& folder) { return step_in(folder, prefix); });
  return folders;
}

/// "480, 540, 600 (set aside)"
std::string steps_text(const fs::path& directory) {
  std::string text;
  const auto add = [&](const std::string& prefix, const char* remark) {
    for (const auto& folder : folders_named(directory, prefix))
      text += fmt::format("{}{}{}", text.empty() ? "" : ", ", step_in(folder), remark);
  };
  add(in_use, "");
  add(set_aside, " (set aside)");
  return text;
}

/// Puts a folder in the place of another, which goes only when the new one is there.
void replace(const fs::path& folder, const fs::path& temporary) {
  const auto old = folder.parent_path() / fmt::format(".{}.old.tmp", folder.filename().string());
  fs::remove_all(old);
  if (fs::exists(folder)) fs::rename(folder, old);
  fs::rename(temporary, folder);
  fs::remove_all(old);
}

}  // namespace

void write_checkpoint(std::int64_t step, const std::function<void(const fs::path&)>& write_state_to,
                      const RowCounts& counts, const fs::path& directory) {
  const auto folder = folder_of(directory, in_use, step);
  const auto temporary = place_of(directory) / fmt::format(".step_{:010}.tmp", step);
  write_state_to(temporary);
  write_row_counts(temporary / row_counts_file, counts);
  replace(folder, temporary);
  remove_old_checkpoints(directory);
  for (const auto& aside : folders_named(directory, set_aside)) {
    if (step_in(aside) <= step) fs::remove_all(aside);
  }
}

void remove_old_checkpoints(const fs::path& directory) {
  auto folders = checkpoint_folders(directory);
  while (folders.size() > 2) {
    fs::remove_all(folders.front());
    folders.erase(folders.begin());
  }
}

std::vector<fs::path> checkpoint_folders(const fs::path& directory) {
  return folders_named(directory, in_use);
}

fs::path find_checkpoint(const fs::path& directory, std::optional<std::int64_t> step) {
  const auto folders = checkpoint_folders(directory);
  if (folders.empty()) {
    throw InputError(
        fmt::format("{}: no checkpoint to resume from (looked for checkpoints/step_*); start the case anew",
                    directory.string()));
  }
  if (!step) return folders.back();
  for (const auto& prefix : {in_use, set_aside}) {
    const auto folder = folder_of(directory, prefix, *step);
    if (fs::is_directory(folder)) return folder;
  }
  throw InputError(
      fmt::format("--from-step {}: {} holds no checkpoint of that step; there are those of steps {}", *step,
                  directory.string(), steps_text(directory)));
}

std::vector<fs::path> other_checkpoints(const fs::path& directory, const fs::path& folder) {
  auto others = folders_named(directory, in_use);
  for (const auto& aside : folders_named(directory, set_aside)) others.push_back(aside);
  std::erase(others, folder);
  std::ranges::sort(others, std::greater(), [](const fs::path& other) { return step_in(other); });
  return others;
}

Checkpoint read_checkpoint(const fs::path& folder, bool with_pieces) {
  Checkpoint checkpoint{read_state(folder, with_pieces), read_row_counts(folder / row_counts_file)};
  return checkpoint;
}

fs::path make_last(const fs::path& directory, const fs::path& folder) {
  const auto step = step_in(folder);
  for (const auto& later : checkpoint_folders(directory)) {
    if (step_in(later) <= step) continue;
    const auto aside = folder_of(directory, set_aside, step_in(later));
    fs::remove_all(aside);  // an older one of that step
    fs::rename(later, aside);
  }
  const auto place = folder_of(directory, in_use, step);
  if (folder != place) fs::rename(folder, place);
  return place;
}

}  // namespace tanktread::driver
