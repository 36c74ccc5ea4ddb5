#include "driver/run/checkpoint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "driver/program/errors.hpp"
#include "exchange/vtk_files.hpp"

namespace tanktread::driver {
void write_checkpoint(const System& system, const std::filesystem::path& directory) {
  const auto place = directory / "checkpoints";
  const auto folder = place / fmt::format("step_{:010}", system.step);
  if (std::filesystem::exists(folder))
    return;  // the same state: a run is the same however often it is resumed
  const auto temporary = place / fmt::format(".step_{:010}.tmp", system.step);
  write_state(temporary, system);
  std::filesystem::rename(temporary, folder);
  remove_old_checkpoints(directory);
}

void remove_old_checkpoints(const std::filesystem::path& directory) {
  auto folders = checkpoint_folders(directory);
  while (folders.size() > 2) {
    std::filesystem::remove_all(folders.front());
    folders.erase(folders.begin());
  }
}

std::vector<std::filesystem::path> checkpoint_folders(const std::filesystem::path& directory) {
  std::vector<std::filesystem::path> folders;
  if (!std::filesystem::is_directory(directory / "checkpoints")) return folders;
  for (const auto& entry : std::filesystem::directory_iterator(directory / "checkpoints")) {
    if (entry.path().filename().string().starts_with("step_")) folders.push_back(entry.path());
  }
  std::sort(folders.begin(), folders.end());
  return folders;
}

SavedState read_last_checkpoint(const std::filesystem::path& directory) {
  const auto folders = checkpoint_folders(directory);
  if (folders.empty()) {
    throw InputError(
        fmt::format("{}: no checkpoint to resume from (looked for checkpoints/step_*); start the case anew",
                    directory.string()));
  }
  try {
    return read_state(folders.back());
  } catch (const exchange::FileError& error) {
    const bool has_other = folders.size() > 1;
    throw InputError(fmt::format("{}\n{}: the checkpoint cannot be used; {}", error.what(),
                                 folders.back().string(),
                                 has_other ? "remove it to go on from " + folders[folders.size() - 2].string()
                                           : std::string("there is no other, start the case anew")));
  }
}

}  // namespace tanktread::driver
