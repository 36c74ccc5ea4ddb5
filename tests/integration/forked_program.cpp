// main() of tests that call the program often: a process that has never computed waits from the start of the
// test program, and becomes the program when it is asked for. That is quicker than an exec()
// with the libraries of VTK.
#include "tests/integration/forked_program.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <stdexcept>
#include <vector>

#include "driver/program_main.hpp"

namespace tanktread::testing {
namespace {

/// The end of the test program's line to the process that waits; -1: there is none.
int line_to_waiting = -1;

constexpr std::size_t most_bytes = 65536;

/// The words of a message, each with a zero byte behind it.
std::vector<char*> words_of(std::vector<char>& message) {
  std::vector<char*> words;
  for (std::size_t begin = 0; begin < message.size(); begin += std::string(&message[begin]).size() + 1)
    words.push_back(&message[begin]);
  return words;
}

/// The program, in a process of its own. @param words the log, and the arguments
[[noreturn]] void become_program(std::vector<char*> words) {
  const int log = open(words.front(), O_CREAT | O_WRONLY | O_TRUNC, 0644);
  if (dup2(log, STDOUT_FILENO) < 0 || dup2(log, STDERR_FILENO) < 0) _exit(127);
  static char name[] = "tanktread";
  words.front() = name;
  const int n = static_cast<int>(words.size());
  words.push_back(nullptr);
  std::exit(driver::program_main(n, words.data()));
}

/// Answers each message with the status of the program's end, until the test program is gone.
[[noreturn]] void wait_for_orders(int line) {
  std::vector<char> message(most_bytes);
  for (;;) {
    message.resize(most_bytes);
    const auto n = recv(line, message.data(), message.size(), 0);
    if (n <= 0) _exit(0);
    message.resize(static_cast<std::size_t>(n));
    const pid_t child = fork();
    if (child == 0) {
      close(line);
      become_program(words_of(message));
    }
    int status = 0;
    if (child < 0 || waitpid(child, &status, 0) != child) _exit(1);  // which the test program then says
    if (send(line, &status, sizeof status, MSG_NOSIGNAL) < 0) _exit(0);
  }
}

void fork_the_one_that_waits() {
  std::array<int, 2> ends;
  if (socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends.data()) != 0) return;
  const pid_t child = fork();
  if (child == 0) {
    close(ends[0]);
    wait_for_orders(ends[1]);
  }
  close(ends[1]);
  line_to_waiting = ends[0];
}

}  // namespace

int run_forked(const std::vector<std::string>& arguments, const std::string& log) {
  std::string message = log + '\0';
  for (const auto& argument : arguments) message += argument + '\0';
  int status = 0;
  if (message.size() > most_bytes ||
      send(line_to_waiting, message.data(), message.size(), MSG_NOSIGNAL) < 0 ||
      recv(line_to_waiting, &status, sizeof status, 0) != sizeof status)
    throw std::runtime_error("the process that is to become the program does not answer");
  return status;
}

}  // namespace tanktread::testing

int main(int argc, char** argv) {
  tanktread::testing::fork_the_one_that_waits();  // before a thread is made: libgomp does not survive a fork
  testing::InitGoogleMock(&argc, argv);
  return RUN_ALL_TESTS();
}
