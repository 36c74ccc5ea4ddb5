#include "driver/outside/child_process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <climits>
#include <csignal>
#include <cstring>
#include <string_view>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

namespace tanktread::driver {
namespace {

using std::chrono::duration_cast;
using std::chrono::milliseconds;

/// The longest line that is an answer: a path and its end.
constexpr std::size_t longest_line = 4097;
/// A time limit beyond this is none: ten years.
constexpr std::chrono::duration<double> longest_wait = std::chrono::hours(24 * 3650);

[[noreturn]] void fail(int error, const char* what) {
  throw std::system_error(error, std::generic_category(), what);
}

/// Both ends of a pipe; those that nobody took are closed.
struct Pipe {
  Pipe() {
    if (::pipe2(ends, O_CLOEXEC) != 0) fail(errno, "no pipe");
  }
  ~Pipe() {
    for (const int end : ends) {
      if (end >= 0) ::close(end);
    }
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;

  int take(int end) { return std::exchange(ends[end], -1); }

  int ends[2] = {-1, -1};  ///< read, write
};

/// What the new process begins with: pipes for standard input and output, a group of its own, and the signals
/// that we ignore at their default.
class Beginning {
 public:
  Beginning(int input, int output) {
    posix_spawn_file_actions_init(&actions_);
    posix_spawn_file_actions_adddup2(&actions_, input, STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&actions_, output, STDOUT_FILENO);
    posix_spawnattr_init(&attributes_);
    posix_spawnattr_setpgroup(&attributes_, 0);
    sigset_t ignored;
    sigemptyset(&ignored);
    sigaddset(&ignored, SIGPIPE);
    sigaddset(&ignored, SIGXFSZ);
    posix_spawnattr_setsigdefault(&attributes_, &ignored);
    posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGDEF);
  }
  ~Beginning() {
    posix_spawn_file_actions_destroy(&actions_);
    posix_spawnattr_destroy(&attributes_);
  }
  Beginning(const Beginning&) = delete;
  Beginning& operator=(const Beginning&) = delete;

  const posix_spawn_file_actions_t* actions() const { return &actions_; }
  const posix_spawnattr_t* attributes() const { return &attributes_; }

 private:
  posix_spawn_file_actions_t actions_;
  posix_spawnattr_t attributes_;
};

/// While it lives a write to a program that has ended is an error, and not our end.
class BrokenPipeIsAnError {
 public:
  BrokenPipeIsAnError() : before_(std::signal(SIGPIPE, SIG_IGN)) {}
  ~BrokenPipeIsAnError() { std::signal(SIGPIPE, before_); }
  BrokenPipeIsAnError(const BrokenPipeIsAnError&) = delete;
  BrokenPipeIsAnError& operator=(const BrokenPipeIsAnError&) = delete;

 private:
  void (*before_)(int);
};

/// The beginning of what a program wrote, for a message.
std::string shown(const std::string& text) {
  constexpr std::size_t n_shown = 60;
  const auto line = text.substr(0, std::min(text.find('\n'), n_shown));
  return line.size() < text.size() ? line + "..." : line;
}

/// Our environment without what mpirun tells its ranks by: a program that uses MPI itself would take itself
/// for one of them.
std::vector<char*> environment_of_program() {
  std::vector<char*> kept;
  for (char** variable = environ; *variable != nullptr; ++variable) {
    const std::string_view text = *variable;
    const auto begins_with = [&](std::string_view prefix) { return text.starts_with(prefix); };
    if (std::ranges::none_of(std::array{"OMPI_COMM_WORLD_", "PMIX_", "PMI_"}, begins_with))
      kept.push_back(*variable);
  }
  kept.push_back(nullptr);
  return kept;
}

}  // namespace

ChildProcess::ChildProcess(const std::vector<std::string>& command, double seconds) : time_limit_(seconds) {
  Pipe to_child, from_child;
  const Beginning beginning(to_child.ends[0], from_child.ends[1]);
  std::vector<char*> arguments;
  for (const auto& argument : command) arguments.push_back(const_cast<char*>(argument.c_str()));
  arguments.push_back(nullptr);
  const auto environment = environment_of_program();
  const int error = posix_spawnp(&process_, arguments[0], beginning.actions(), beginning.attributes(),
                                 arguments.data(), environment.data());
  if (error != 0) fail(error, arguments[0]);
  input_ = to_child.take(1);
  output_ = from_child.take(0);
}

ChildProcess::~ChildProcess() {
  ::close(input_);
  if (!has_ended(deadline())) {
    fmt::print(stderr,
               "tanktread: warning: a program did not end within {:g} s after its last step; killed\n",
               time_limit_.count());
    kill();
  }
  ::close(output_);
}

std::string ChildProcess::ask(const std::string& line) {
  const auto in_time = deadline();
  if (is_readable(Clock::now())) receive();
  if (!received_.empty()) {
    give_up(
        fmt::format("it wrote '{}' to its standard output before it was asked, where only the names of its "
                    "packets go; messages go to its standard error",
                    shown(received_)));
  }
  send(line, in_time);
  while (received_.find('\n') == std::string::npos) {
    if (received_.size() > longest_line) {
      give_up(fmt::format("it wrote '{}' and no end of a line; it must answer with the name of its packet",
                          shown(received_)));
    }
    if (!is_readable(in_time)) give_up_waiting();
    receive();
  }
  return taken_line();
}

std::string ChildProcess::taken_line() {
  auto text = std::exchange(received_, "");
  if (text.find('\n') + 1 != text.size()) {
    give_up(
        fmt::format("it answered with more than one line, '{}'; only the name of its packet goes to its "
                    "standard output, messages to its standard error",
                    shown(text)));
  }
  text.pop_back();
  if (text.ends_with('\r')) text.pop_back();
  return text;
}

void ChildProcess::give_up(const std::string& why) {
  kill();
  throw NoAnswer(why);
}

ChildProcess::Clock::time_point ChildProcess::deadline() const {
  return Clock::now() + duration_cast<Clock::duration>(std::min(time_limit_, longest_wait));
}

void ChildProcess::send(const std::string& line, Clock::time_point in_time) {
  const BrokenPipeIsAnError guard;
  const auto text = line + '\n';
  for (std::size_t done = 0; done < text.size();) {
    if (!is_ready(input_, POLLOUT, in_time)) give_up_waiting();
    // A pipe that is ready takes PIPE_BUF bytes without waiting, and no more is sure.
    const auto written =
        ::write(input_, text.data() + done, std::min<std::size_t>(text.size() - done, PIPE_BUF));
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) report_end();
    done += static_cast<std::size_t>(written);
  }
}

void ChildProcess::give_up_waiting() {
  give_up(fmt::format("it gave no answer within {:g} s (run.command_time_limit) and was killed",
                      time_limit_.count()));
}

bool ChildProcess::is_readable(Clock::time_point deadline) const {
  return is_ready(output_, POLLIN, deadline);
}

bool ChildProcess::is_ready(int descriptor, short event, Clock::time_point deadline) {
  for (;;) {
    const auto left = std::max(deadline - Clock::now(), Clock::duration::zero());
    const auto patience =
        std::min(std::chrono::ceil<milliseconds>(left), milliseconds(std::chrono::hours(1)));
    pollfd pipe{descriptor, event, 0};
    const int n_ready = ::poll(&pipe, 1, static_cast<int>(patience.count()));
    if (n_ready > 0) return true;
    // A signal that wants the run to end waits until the step is done.
    if (n_ready < 0 && errno != EINTR) fail(errno, "poll");
    if (n_ready == 0 && Clock::now() >= deadline) return false;
  }
}

void ChildProcess::receive() {
  char text[4096];
  const auto n_read = ::read(output_, text, sizeof text);
  if (n_read < 0 && errno == EINTR) return;
  if (n_read <= 0) report_end();
  received_.append(text, static_cast<std::size_t>(n_read));
}

bool ChildProcess::has_ended(Clock::time_point deadline) {
  for (auto pause = milliseconds(1); process_ != -1; pause = std::min(2 * pause, milliseconds(50))) {
    const pid_t ended = ::waitpid(process_, &status_, WNOHANG);
    if (ended == process_ || (ended < 0 && errno == ECHILD)) process_ = -1;
    if (ended != 0) continue;
    if (Clock::now() >= deadline) return false;
    std::this_thread::sleep_for(pause);
  }
  return true;
}

void ChildProcess::kill() {
  if (process_ == -1) return;
  ::kill(-process_, SIGKILL);  // with what it has started itself
  while (::waitpid(process_, &status_, 0) < 0 && errno == EINTR) {
  }
  process_ = -1;
}

void ChildProcess::report_end() {
  if (!has_ended(Clock::now() + std::chrono::seconds(1))) {
    give_up("it closed its standard input or output and gave no answer");
  }
  if (WIFSIGNALED(status_)) {
    throw NoAnswer(fmt::format("it was ended by signal {} ({}) and gave no answer", WTERMSIG(status_),
                               strsignal(WTERMSIG(status_))));
  }
  throw NoAnswer(fmt::format("it ended with exit code {} and gave no answer", WEXITSTATUS(status_)));
}

}  // namespace tanktread::driver
