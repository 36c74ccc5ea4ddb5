// Runs the program, and looks at what it leaves behind.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace tanktread::testing {

struct Ended {
  int exit_code = 0;   ///< 128 + signal if a signal killed it
  std::string output;  ///< stdout and stderr together
};

/// Runs the program with these arguments and waits for its end: the executable, as a user does, or with
/// TANKTREAD_FORKED a fork of the test program (forked_program.hpp).
Ended run_program(const std::vector<std::string>& arguments);

/// Starts it, waits until `ready()` (at most a minute), sends the signal, waits for its end.
Ended run_and_signal(const std::vector<std::string>& arguments, int signal,
                     const std::function<bool()>& ready);

/// A fresh directory of this test's own, removed when the object goes.
class TemporaryDirectory {
 public:
  TemporaryDirectory();
  ~TemporaryDirectory();
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

std::string read_file(const std::filesystem::path& file);

/// The results of a run (all but its checkpoints), by relative path, with their bytes.
std::vector<std::pair<std::string, std::string>> result_files(const std::filesystem::path& directory);

}  // namespace tanktread::testing
