// The ranks of a run: who they are, what they tell each other, how they end.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

namespace tanktread::ranks {

/// Bytes that go to a rank, or have come from it.
struct Message {
  int rank = 0;
  std::vector<std::byte> bytes;
};

/// Built with TANKTREAD_MPI, the processes that mpirun has started; else, and without mpirun, this one alone.
/// One a program, made before all else in main(). Its functions are for the thread that made it; all ranks
/// call those that say "together", in the same order.
class World {
 public:
  /// Begins MPI, if this process is one of mpirun's (or srun's). The arguments are those of main().
  /// @throws std::runtime_error if MPI cannot begin, or is not built in where there are several processes
  World(int* argc, char*** argv);
  /// Ends MPI. Together.
  ~World();
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  int rank() const { return rank_; }
  int size() const { return size_; }
  bool is_first() const { return rank_ == 0; }

  /// "Open MPI v4.1.4"; "none".
  static const char* library();

  /// Ends all ranks at once with this exit code, wherever they are. What this rank has to say must have been
  /// said and flushed.
  [[noreturn]] void abort(int exit_code) const;

  /// Returns when all have called it. Together.
  void wait_for_all() const;

  /// The highest of all ranks' numbers, on each of them; no number may be NaN. Together.
  double highest(double number) const;

  /// What send() gives to MPI at once, which counts in int.
  static constexpr std::size_t most_bytes_at_once = std::size_t{1} << 28;

  /// Sends bytes to another rank, which receive()s them; the messages between two ranks come in the order in
  /// which they were sent. May return before they have come.
  void send(int rank, std::span<const std::byte> bytes) const;

  /// Waits for the next message of another rank.
  std::vector<std::byte> receive(int rank) const;

  /// Sends some ranks, itself perhaps among them, a message each, of which they need not know. Together.
  /// @return what has come to this rank, ascending by rank
  std::vector<Message> exchange(std::vector<Message> outgoing) const;

  /// The same where it is known who sends: one message comes from each of `senders`, which ascend. Of those
  /// concerned; others need not call it.
  std::vector<Message> exchange(std::vector<Message> outgoing, std::span<const int> senders) const;

  /// The numbers of all ranks, one rank's after the other's. Together.
  std::vector<double> all_numbers(std::span<const double> numbers) const;

 private:
  friend class NeighbourMessages;
  struct Communicator;
  std::unique_ptr<Communicator> communicator_;
  int rank_ = 0, size_ = 1;
};

}  // namespace tanktread::ranks
