// A program at work beside this one, asked line by line.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <stdexcept>
#include <string>
#include <vector>

namespace tanktread::driver {

/// A program gave no answer, or not one line. The message says what it did instead, without its name: "it
/// ended with exit code 1 and gave no answer".
class NoAnswer : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A program with pipes on its standard input and output; its standard error is ours. It is in a process
/// group of its own, so that Ctrl-C at the keyboard ends the run by a checkpoint and not the program in
/// mid-step.
class ChildProcess {
 public:
  /// Starts it. @param command the program, found by PATH unless it is a path, and its arguments
  /// @param seconds that it may take for an answer, and at the end
  /// @throws std::system_error if it cannot be started
  ChildProcess(const std::vector<std::string>& command, double seconds);

  /// Closes its standard input, waits for its end, and kills it if that does not come in time.
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// Writes a line to its standard input and returns the line that it answers, without the line's end.
  /// @throws NoAnswer if it ends, does not answer in time, or writes anything but one line; it is killed then
  std::string ask(const std::string& line);

 private:
  using Clock = std::chrono::steady_clock;

  Clock::time_point deadline() const;  ///< of what begins now
  void send(const std::string& line, Clock::time_point in_time);
  std::string taken_line();
  /// Waits until there is something to read. @return false at the deadline
  bool is_readable(Clock::time_point deadline) const;
  /// Waits until an end of a pipe can be read or written (POLLIN, POLLOUT). @return false at the deadline
  static bool is_ready(int descriptor, short event, Clock::time_point deadline);
  /// Appends what can be read to `received_`. @throws NoAnswer if that is the end
  void receive();
  /// Waits for its end. @return false at the deadline
  bool has_ended(Clock::time_point deadline);
  void kill();
  [[noreturn]] void give_up(const std::string& why);
  [[noreturn]] void give_up_waiting();
  [[noreturn]] void report_end();

  std::chrono::duration<double> time_limit_;
  pid_t process_ = -1;  ///< -1: it has ended
  int status_ = 0;      ///< of waitpid, once it has ended
  int input_ = -1, output_ = -1;
  std::string received_;
};

}  // namespace tanktread::driver
