// A run that has got half way, ways to spoil its files, and to go on with it.
#pragma once

#include <algorithm>
#include <sstream>

#include "tests/integration/run_fixture.hpp"

namespace tanktread::testing {

using Contents = std::vector<std::pair<std::string, std::string>>;

/// Every file and folder below a directory with its bytes.
inline Contents contents_of(const std::filesystem::path& directory) {
  Contents contents;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(directory)) {
    contents.emplace_back(std::filesystem::relative(entry.path(), directory).string(),
                          entry.is_regular_file() ? read_file(entry.path()) : "");
  }
  std::ranges::sort(contents);
  return contents;
}

inline void write_file(const std::filesystem::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
}

inline void replace_in(const std::filesystem::path& file, const std::string& what, const std::string& with) {
  auto text = read_file(file);
  const auto at = text.find(what);
  ASSERT_NE(at, std::string::npos) << file << " has no " << what;
  write_file(file, text.replace(at, what.size(), with));
}

inline void keep_lines(const std::filesystem::path& file, int n) {
  std::istringstream input(read_file(file));
  std::string kept;
  for (std::string line; n > 0 && std::getline(input, line); --n) kept += line + "\n";
  write_file(file, kept);
}

inline void keep_half(const std::filesystem::path& file) {
  const auto text = read_file(file);
  write_file(file, text.substr(0, text.size() / 2));
}

inline void to_windows_line_ends(const std::filesystem::path& file) {
  std::string text;
  for (const char c : read_file(file)) text += c == '\n' ? std::string("\r\n") : std::string(1, c);
  write_file(file, text);
}

class Resume : public Run {
 protected:
  /// A run to step 180 with checkpoints of steps 120 and 180, all outputs among them.
  void run_half() const {
    const auto ended =
        run_program(run_to("half", {"--shear-time", "0.3", "--set", "output.fluid_every=0.1"}));
    ASSERT_EQ(ended.exit_code, 0) << ended.output;
  }
  void run_whole() const {
    const auto ended =
        run_program(run_to("whole", {"--shear-time", "0.4", "--set", "output.fluid_every=0.1"}));
    ASSERT_EQ(ended.exit_code, 0) << ended.output;
  }
  std::filesystem::path copy_of_half(const std::string& name) const {
    std::filesystem::remove_all(directory_ / name);
    std::filesystem::copy(directory_ / "half", directory_ / name, std::filesystem::copy_options::recursive);
    return directory_ / name;
  }
  Ended resume(const std::filesystem::path& run, const std::vector<std::string>& options) const {
    std::vector<std::string> arguments = {"run", "--resume", run.string()};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return run_program(arguments);
  }
  static bool is_there(const std::filesystem::path& run, const std::string& checkpoint) {
    return std::filesystem::exists(run / "checkpoints" / checkpoint);
  }
};

}  // namespace tanktread::testing
