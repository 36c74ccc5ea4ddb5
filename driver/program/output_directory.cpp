#include "driver/program/output_directory.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <regex>
#include <vector>

#include "driver/program/errors.hpp"
#include "exchange/shell_text.hpp"

namespace tanktread::driver {
namespace {

constexpr const char* lock_name = ".lock";

/// What a run writes, and what is drawn of it. echo.toml last: until it goes, the directory is known for what
/// it is.
constexpr std::array names_of_run = {
    "checkpoints",  "packets",         "fluid",           "fluid.pvd",   "membrane",
    "membrane.pvd", "deformation.png", "inclination.png", "capsule.png", "observables.csv",
    "measures.csv", "energy.csv",      "parameters.toml", "echo.toml"};

/// What a process leaves that was killed before its first file was there counts as nothing.
bool holds_anything(const std::filesystem::path& directory) {
  for (const auto& entry : std::filesystem::directory_iterator(directory)) {
    if (entry.path().filename() != lock_name && !is_temporary(entry.path())) return true;
  }
  return false;
}

/// The path above one that is not there which is: its directory, or a file in the way.
std::filesystem::path nearest_above(const std::filesystem::path& path) {
  auto above = std::filesystem::absolute(path).lexically_normal();
  while (!std::filesystem::exists(above) && above.has_relative_path()) above = above.parent_path();
  return above;
}

}  // namespace

DirectoryLock::DirectoryLock(const std::filesystem::path& directory) {
  std::error_code error;
  std::filesystem::create_directories(directory, error);
  descriptor_ = open((directory / lock_name).c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0666);
  if (error || descriptor_ < 0) {
    throw InputError(fmt::format("{}: the directory cannot be written: {}; choose another",
                                 directory.string(), error ? error.message() : std::strerror(errno)));
  }
  if (flock(descriptor_, LOCK_EX | LOCK_NB) != 0) {
    close(descriptor_);
    throw InputError(
        fmt::format("{}: another tanktread process is at work in it; wait for it, stop it, or choose "
                    "another directory",
                    directory.string()));
  }
}

DirectoryLock::~DirectoryLock() {
  close(descriptor_);
}

void require_new_directory(const std::string& option, const std::filesystem::path& directory) {
  if (!std::filesystem::exists(directory)) {
    const auto above = nearest_above(directory);
    if (std::filesystem::is_directory(above)) return;
    throw InputError(fmt::format("{} {}: cannot be made, for {} is no directory; give another directory",
                                 option, directory.string(), above.string()));
  }
  const bool is_directory = std::filesystem::is_directory(directory);
  if (is_directory && !holds_anything(directory)) return;
  throw InputError(fmt::format("{} {}: {}; give a new or an empty directory", option, directory.string(),
                               is_directory ? "holds something already" : "is no directory"));
}

void check_output_directory(const std::filesystem::path& directory, bool force) {
  if (!std::filesystem::exists(directory)) return;
  if (!std::filesystem::is_directory(directory)) {
    throw InputError(fmt::format("--output {}: is a file; choose a directory", directory.string()));
  }
  if (!holds_anything(directory)) return;
  if (!force) {
    throw InputError(
        fmt::format("--output {}: the directory is not empty and is never overwritten by itself; "
                    "choose another, add --force to remove the earlier run, or go on from it with "
                    "--resume {}",
                    directory.string(), exchange::shell_text(directory)));
  }
  if (!std::filesystem::exists(directory / "echo.toml")) {
    throw InputError(
        fmt::format("--output {}: --force removes an earlier run only, and there is none (no "
                    "echo.toml); choose another directory",
                    directory.string()));
  }
  if (std::filesystem::exists(directory / "begin")) {
    throw InputError(fmt::format(
        "--output {}: --force removes an earlier run only, and it holds a record of --record; choose "
        "another directory, or remove the record yourself",
        directory.string()));
  }
}

bool is_temporary(const std::filesystem::path& file) {
  static const std::regex pattern(R"(\.(.+\.[0-9]+-[0-9]+|step_[0-9]+(\.old)?)\.tmp)");
  return std::regex_match(file.filename().string(), pattern);
}

bool is_place_of_run(const std::filesystem::path& directory, const std::filesystem::path& path) {
  const auto inside = std::filesystem::weakly_canonical(path).lexically_relative(
      std::filesystem::weakly_canonical(directory));
  if (inside.empty() || inside == ".") return inside == ".";
  return std::ranges::find(names_of_run, inside.begin()->string()) != names_of_run.end();
}

std::optional<std::filesystem::path> run_that_owns(const std::filesystem::path& path) {
  for (auto above = std::filesystem::weakly_canonical(path).parent_path();; above = above.parent_path()) {
    const bool is_run =
        std::filesystem::exists(above / "echo.toml") && std::filesystem::is_directory(above / "checkpoints");
    if (is_run && is_place_of_run(above, path)) return above;
    if (above == above.root_path()) return std::nullopt;
  }
}

void remove_earlier_run(const std::filesystem::path& directory) {
  for (const char* name : names_of_run) std::filesystem::remove_all(directory / name);
}

void remove_temporary_files(const std::filesystem::path& directory) {
  for (const auto& place : {directory, directory / "checkpoints", directory / "packets"}) {
    if (!std::filesystem::is_directory(place)) continue;
    std::vector<std::filesystem::path> left;
    for (const auto& entry : std::filesystem::directory_iterator(place)) {
      if (is_temporary(entry.path())) left.push_back(entry.path());
    }
    for (const auto& path : left) std::filesystem::remove_all(path);
  }
}

}  // namespace tanktread::driver
