#include "tests/integration/program.hpp"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <thread>

#ifdef TANKTREAD_FORKED
#include "tests/integration/forked_program.hpp"
#endif

namespace tanktread::testing {
namespace {

pid_t start_program(const std::vector<std::string>& arguments, const std::filesystem::path& log) {
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("fork failed");
  if (child == 0) {
    const int file = open(log.c_str(), O_CREAT | O_WRONLY | O_TRUNC, 0644);
    dup2(file, STDOUT_FILENO);
    dup2(file, STDERR_FILENO);
    std::vector<char*> argv = {const_cast<char*>(TANKTREAD_PROGRAM)};
    for (const auto& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
    argv.push_back(nullptr);
    execv(TANKTREAD_PROGRAM, argv.data());
    _exit(127);
  }
  return child;
}

Ended ended(int status, const std::filesystem::path& log) {
  const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return {code, read_file(log)};
}

Ended wait_for(pid_t child, const std::filesystem::path& log) {
  int status = 0;
  waitpid(child, &status, 0);
  return ended(status, log);
}

}  // namespace

Ended run_program(const std::vector<std::string>& arguments) {
  const TemporaryDirectory directory;
#ifdef TANKTREAD_FORKED
  return ended(run_forked(arguments, directory / "log"), directory / "log");
#else
  return wait_for(start_program(arguments, directory / "log"), directory / "log");
#endif
}

Ended run_and_signal(const std::vector<std::string>& arguments, int signal,
                     const std::function<bool()>& ready) {
  const TemporaryDirectory directory;
  const pid_t child = start_program(arguments, directory / "log");
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (!ready() && std::chrono::steady_clock::now() < deadline) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  const bool was_ready = ready();
  kill(child, signal);
  const auto ended = wait_for(child, directory / "log");
  if (!was_ready) throw std::runtime_error("not ready for the signal within a minute: " + ended.output);
  return ended;
}

TemporaryDirectory::TemporaryDirectory() {
  auto pattern = (std::filesystem::temp_directory_path() / "tanktread-test-XXXXXX").string();
  if (mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("mkdtemp failed");
  path_ = pattern;
}

TemporaryDirectory::~TemporaryDirectory() {
  std::filesystem::remove_all(path_);
}

std::string read_file(const std::filesystem::path& file) {
  std::ifstream input(file, std::ios::binary);
  std::ostringstream text;
  text << input.rdbuf();
  return text.str();
}

std::vector<std::pair<std::string, std::string>> result_files(const std::filesystem::path& directory) {
  std::vector<std::pair<std::string, std::string>> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(directory)) {
    const auto name = std::filesystem::relative(entry.path(), directory).string();
    if (entry.is_regular_file() && !name.starts_with("checkpoints") && name != ".lock")
      files.emplace_back(name, read_file(entry.path()));
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace tanktread::testing
