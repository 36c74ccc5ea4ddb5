#include "driver/program/memory.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <optional>
#include <sstream>

#include "driver/program/errors.hpp"

namespace tanktread::driver {
namespace {

using std::filesystem::path;
constexpr double infinity = std::numeric_limits<double>::infinity();

/// The number after a name, as in "MemAvailable:   20935416 kB"; the first of the file with an empty name.
/// "max" is none.
std::optional<double> number_in(const path& file, const std::string& name = "") {
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);) {
    std::istringstream words(line);
    std::string found;
    double value = 0;
    if (!name.empty() && (!(words >> found) || found != name)) continue;
    return words >> value ? std::optional(value) : std::nullopt;
  }
  return std::nullopt;
}

/// Control groups of version 1 and 2 say the same in other files.
struct GroupFiles {
  const char *mount, *limit, *usage, *droppable;
};
constexpr GroupFiles version_1 = {"sys/fs/cgroup/memory", "memory.limit_in_bytes", "memory.usage_in_bytes",
                                  "total_inactive_file"};
constexpr GroupFiles version_2 = {"sys/fs/cgroup", "memory.max", "memory.current", "inactive_file"};

double left_in(const path& group, const GroupFiles& files) {
  const auto limit = number_in(group / files.limit), usage = number_in(group / files.usage);
  if (!limit || !usage) return infinity;
  return std::max(0.0, *limit - *usage + number_in(group / "memory.stat", files.droppable).value_or(0));
}

/// The least of a group and all that it lies in. Inside a container the group's path may be that of outside,
/// and the container's own is the mount itself.
double left_in_groups(const path& root, const std::string& group, const GroupFiles& files) {
  const auto mount = root / files.mount;
  double least = left_in(mount, files);
  auto at = mount;
  for (const auto& part : path(group).relative_path()) {
    at /= part;
    least = std::min(least, left_in(at, files));
  }
  return least;
}

}  // namespace

double available_memory_bytes(const path& root) {
  double least = infinity;
  if (const auto kilobytes = number_in(root / "proc/meminfo", "MemAvailable:")) least = 1024 * *kilobytes;
  std::ifstream groups(root / "proc/self/cgroup");
  for (std::string line; std::getline(groups, line);) {  // "4:memory:/a/b", "0::/a/b"
    const auto first = line.find(':'), second = line.find(':', first + 1);
    if (second == std::string::npos) continue;
    const auto controllers = "," + line.substr(first + 1, second - first - 1) + ",";
    const auto group = line.substr(second + 1);
    if (controllers == ",,") least = std::min(least, left_in_groups(root, group, version_2));
    if (controllers.find(",memory,") != std::string::npos)
      least = std::min(least, left_in_groups(root, group, version_1));
  }
  return least;
}

void require_memory(double bytes, const std::string& what, double available) {
  if (bytes <= available) return;
  throw InputError(
      fmt::format("{}: needs about {} of memory, of which {} are available here; make it smaller, end other "
                  "programs, or use a machine with more (tanktread plan --no-trial says what a case needs)",
                  what, bytes_text(bytes), bytes_text(available)));
}

std::string bytes_text(double bytes) {
  if (bytes >= 1e12) return fmt::format("{:.4g} TB", 1e-12 * bytes);
  if (bytes >= 1e9) return fmt::format("{:.2f} GB", 1e-9 * bytes);
  return bytes >= 1e6 ? fmt::format("{:.1f} MB", 1e-6 * bytes) : fmt::format("{:.1f} kB", 1e-3 * bytes);
}

}  // namespace tanktread::driver
