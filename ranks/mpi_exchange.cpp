// World's messages among ranks, some of which do not know who will write to them.
#include <algorithm>
#include <climits>
#include <iterator>
#include <stdexcept>
#include <string>
#include <utility>

#include "ranks/mpi_world.hpp"

namespace tanktread::ranks {
namespace {

/// Tags. A rank may begin the next exchange before another has seen the end of the last, so two take turns.
constexpr int known_tag = 1, unknown_tags[] = {2, 3};

/// Before the first of them is sent: MPI reads their memory until they have gone.
void check_sizes(const std::vector<Message>& outgoing) {
  for (const auto& message : outgoing) {
    if (message.bytes.size() <= INT_MAX) continue;
    throw std::logic_error("a message to rank " + std::to_string(message.rank) + " has " +
                           std::to_string(message.bytes.size()) + " bytes, MPI can send " +
                           std::to_string(INT_MAX) + "; take more ranks");
  }
}

int count_of(const Message& message) {
  return static_cast<int>(message.bytes.size());
}

/// Takes the message to this rank, which MPI need not see, from the others.
std::vector<Message> take_own(std::vector<Message>& outgoing, int rank) {
  const auto own = std::ranges::stable_partition(
      outgoing, [rank](const Message& message) { return message.rank != rank; });
  std::vector<Message> taken(std::make_move_iterator(own.begin()), std::make_move_iterator(own.end()));
  outgoing.erase(own.begin(), own.end());
  return taken;
}

/// The message of which a probe has told.
Message received(const MPI_Status& status, MPI_Comm all) {
  int size = 0;
  MPI_Get_count(&status, MPI_BYTE, &size);
  Message message{status.MPI_SOURCE, std::vector<std::byte>(static_cast<std::size_t>(size))};
  MPI_Recv(message.bytes.data(), size, MPI_BYTE, status.MPI_SOURCE, status.MPI_TAG, all, MPI_STATUS_IGNORE);
  return message;
}

void wait_for(std::vector<MPI_Request>& requests) {
  MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
}

}  // namespace

// The algorithm of Hoefler, Siebert and Lumsdaine 2010 (doi:10.1145/1693453.1693476): a rank whose messages
// have all been received, which a synchronous send tells, comes to a barrier that does not block; whoever
// sees its end knows that nothing is under way any more. No rank has to hear of ranks that it has nothing to
// do with.
std::vector<Message> World::exchange(std::vector<Message> outgoing) const {
  auto incoming = take_own(outgoing, rank_);
  if (!communicator_->began()) return incoming;
  const MPI_Comm all = communicator_->all;
  const int tag =
      unknown_tags[std::exchange(communicator_->is_odd_exchange, !communicator_->is_odd_exchange)];
  check_sizes(outgoing);
  std::vector<MPI_Request> sends(outgoing.size());
  for (std::size_t k = 0; k < outgoing.size(); ++k) {
    const auto& message = outgoing[k];
    MPI_Issend(message.bytes.data(), count_of(message), MPI_BYTE, message.rank, tag, all, &sends[k]);
  }
  MPI_Request barrier = MPI_REQUEST_NULL;
  for (bool at_barrier = false;;) {
    int is_there = 0, is_done = 0;
    MPI_Status status;
    MPI_Iprobe(MPI_ANY_SOURCE, tag, all, &is_there, &status);
    if (is_there) incoming.push_back(received(status, all));
    if (at_barrier) {
      MPI_Test(&barrier, &is_done, MPI_STATUS_IGNORE);
      if (is_done) break;
    } else {
      MPI_Testall(static_cast<int>(sends.size()), sends.data(), &is_done, MPI_STATUSES_IGNORE);
      if (!is_done) continue;
      MPI_Ibarrier(all, &barrier);
      at_barrier = true;
    }
  }
  std::ranges::sort(incoming, {}, &Message::rank);
  return incoming;
}

std::vector<Message> World::exchange(std::vector<Message> outgoing, std::span<const int> senders) const {
  auto own = take_own(outgoing, rank_);
  if (!communicator_->began()) return own;
  const MPI_Comm all = communicator_->all;
  check_sizes(outgoing);
  std::vector<MPI_Request> sends(outgoing.size());
  for (std::size_t k = 0; k < outgoing.size(); ++k) {
    const auto& message = outgoing[k];
    MPI_Isend(message.bytes.data(), count_of(message), MPI_BYTE, message.rank, known_tag, all, &sends[k]);
  }
  std::vector<Message> incoming;
  for (const int sender : senders) {
    if (sender == rank_) {
      if (own.empty()) throw std::logic_error("a rank waits for a message of its own that it has not sent");
      incoming.push_back(std::move(own.front()));
      continue;
    }
    MPI_Status status;
    MPI_Probe(sender, known_tag, all, &status);
    incoming.push_back(received(status, all));
  }
  wait_for(sends);
  return incoming;
}

std::vector<double> World::all_numbers(std::span<const double> numbers) const {
  if (!communicator_->began()) return {numbers.begin(), numbers.end()};
  const int n_own = static_cast<int>(numbers.size());
  std::vector<int> n_of(static_cast<std::size_t>(size_)), first(n_of.size());
  MPI_Allgather(&n_own, 1, MPI_INT, n_of.data(), 1, MPI_INT, communicator_->all);
  int n_all = 0;
  for (std::size_t k = 0; k < n_of.size(); ++k) {
    first[k] = n_all;
    n_all += n_of[k];
  }
  std::vector<double> all(static_cast<std::size_t>(n_all));
  MPI_Allgatherv(numbers.data(), n_own, MPI_DOUBLE, all.data(), n_of.data(), first.data(), MPI_DOUBLE,
                 communicator_->all);
  return all;
}

}  // namespace tanktread::ranks
