#include "driver/case/case_programs.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <sstream>

#include "driver/case/case_checks.hpp"

namespace tanktread::driver {
namespace {

namespace fs = std::filesystem;

bool can_be_run(const fs::path& file) {
  std::error_code error;
  return fs::is_regular_file(file, error) && ::access(file.c_str(), X_OK) == 0;
}

/// As the system looks for a program.
bool is_program(const std::string& name) {
  if (name.empty()) return false;
  if (name.find('/') != std::string::npos) return fs::path(name).is_absolute() && can_be_run(name);
  const char* path = std::getenv("PATH");
  std::istringstream folders(path != nullptr ? path : "/bin:/usr/bin");
  for (std::string folder; std::getline(folders, folder, ':');) {
    if (can_be_run(fs::path(folder.empty() ? "." : folder) / name)) return true;
  }
  return false;
}

void find_files(std::vector<std::string>& command, const fs::path& directory) {
  for (auto& argument : command) {
    std::error_code error;
    if (!fs::is_regular_file(directory / argument, error)) continue;
    argument = fs::absolute(directory / argument).lexically_normal().string();
  }
}

void check_program(CaseReader& reader, const std::string& path, const std::vector<std::string>& command) {
  if (command.empty() || is_program(command.front())) return;
  reader.problem(path, fmt::format("there is no program '{}' that can be run; give its path (a relative one "
                                   "starts at the case file's folder), or a name that PATH finds",
                                   command.front()));
}

/// A program is told one viscosity.
void check_viscosity(CaseReader& reader, const Case& the_case) {
  for (std::size_t k = 0; k < the_case.capsules.size(); ++k) {
    const double ratio = the_case.capsules[k].viscosity_ratio;
    if (ratio == 1.0) continue;
    reader.problem("flow.command",
                   fmt::format("a program in the place of the fluid has the same viscosity "
                               "everywhere, but capsule {} has viscosity_ratio = {}; remove one "
                               "of them",
                               k, ratio));
  }
  // Ratios follow from these only after the checks.
  if (!the_case.si || !the_case.si->inner_viscosity_Pa_s) return;
  const double inner = *the_case.si->inner_viscosity_Pa_s, outer = the_case.si->viscosity_Pa_s;
  if (inner == outer) return;
  reader.problem("flow.command",
                 fmt::format("a program in the place of the fluid has the same viscosity everywhere, but "
                             "si.inner_viscosity_Pa_s = {} and si.viscosity_Pa_s = {}; remove one of them",
                             inner, outer));
}

}  // namespace

bool has_program(const Case& the_case) {
  return !the_case.flow.command.empty() ||
         std::ranges::any_of(the_case.capsules,
                             [](const CapsuleCase& capsule) { return !capsule.membrane.command.empty(); });
}

void find_program_files(Case& the_case, const fs::path& directory) {
  find_files(the_case.flow.command, directory);
  for (auto& capsule : the_case.capsules) find_files(capsule.membrane.command, directory);
  auto& packets = the_case.run.command_directory;
  if (!packets.empty()) packets = fs::absolute(directory / packets).lexically_normal().string();
}

void check_programs(CaseReader& reader, const Case& the_case, const FilesUsed& used) {
  if (used.fluid_program) check_program(reader, "flow.command", the_case.flow.command);
  if (!the_case.flow.command.empty()) check_viscosity(reader, the_case);
  for (std::size_t k = 0; used.membrane_programs && k < the_case.capsules.size(); ++k) {
    check_program(reader, membrane_path(reader, "command", k), the_case.capsules[k].membrane.command);
  }
}

std::string short_text(const std::vector<std::string>& command) {
  constexpr std::size_t longest = 70;  // so that a line of the echo stays within 100
  std::string text;
  for (const auto& argument : command) {
    const auto name = argument.find('/') == 0 ? fs::path(argument).filename().string() : argument;
    text += (text.empty() ? "" : " ") + name;
  }
  return text.size() <= longest ? text : text.substr(0, longest - 4) + " ...";
}

}  // namespace tanktread::driver
