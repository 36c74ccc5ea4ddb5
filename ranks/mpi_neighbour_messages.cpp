#include <climits>
#include <stdexcept>
#include <string>

#include "ranks/mpi_world.hpp"
#include "ranks/neighbour_messages.hpp"

namespace tanktread::ranks {
namespace {

/// Of a message that goes in a direction, 0 to 26.
int tag_of(const Triple& direction) {
  return (direction[2] + 1) * 9 + (direction[1] + 1) * 3 + direction[0] + 1;
}

/// The number of bytes as MPI takes it.
int count_of(std::size_t size) {
  if (size > INT_MAX)
    throw std::logic_error("a message to a neighbour has " + std::to_string(size) + " bytes, MPI can send " +
                           std::to_string(INT_MAX));
  return static_cast<int>(size);
}

}  // namespace

struct NeighbourMessages::Requests {
  /// Of its own: what is given up meets no other message. Null: MPI has not begun, and there is no message.
  MPI_Comm all = MPI_COMM_NULL;
  std::vector<MPI_Request> receive, send;
  bool under_way = false;
};

NeighbourMessages::NeighbourMessages(const World& world, const Division& division,
                                     std::span<const NeighbourMessage> messages)
    : requests_(std::make_unique<Requests>()) {
  if (!world.communicator_->began()) {
    if (messages.empty()) return;
    throw std::logic_error("this program was started without mpirun: it has no neighbours");
  }
  for (const auto& message : messages)
    if (!division.neighbour(world.rank(), message.direction))
      throw std::logic_error("a message goes to a neighbour that there is not");
  MPI_Comm_dup(world.communicator_->all, &requests_->all);
  const MPI_Comm all = requests_->all;
  for (const auto& message : messages) {
    const auto& to = message.direction;
    const auto neighbour = division.neighbour(world.rank(), to);
    requests_->receive.emplace_back();
    MPI_Recv_init(message.incoming.data(), count_of(message.incoming.size()), MPI_BYTE, *neighbour,
                  tag_of({-to[0], -to[1], -to[2]}), all, &requests_->receive.back());
    requests_->send.emplace_back();
    MPI_Send_init(message.outgoing.data(), count_of(message.outgoing.size()), MPI_BYTE, *neighbour,
                  tag_of(to), all, &requests_->send.back());
  }
}

NeighbourMessages::~NeighbourMessages() {
  if (requests_->all == MPI_COMM_NULL) return;
  if (requests_->under_way) {
    for (auto& request : requests_->receive) MPI_Cancel(&request);
    MPI_Waitall(static_cast<int>(requests_->receive.size()), requests_->receive.data(), MPI_STATUSES_IGNORE);
  }
  for (auto& request : requests_->receive) MPI_Request_free(&request);
  for (auto& request : requests_->send) MPI_Request_free(&request);
  // All free it together; where one has given up, the others may never come to it.
  if (!requests_->under_way) MPI_Comm_free(&requests_->all);
}

void NeighbourMessages::start() {
  if (requests_->all == MPI_COMM_NULL) return;
  MPI_Startall(static_cast<int>(requests_->receive.size()), requests_->receive.data());
  MPI_Startall(static_cast<int>(requests_->send.size()), requests_->send.data());
  requests_->under_way = true;
}

void NeighbourMessages::finish() {
  if (requests_->all == MPI_COMM_NULL) return;
  MPI_Waitall(static_cast<int>(requests_->receive.size()), requests_->receive.data(), MPI_STATUSES_IGNORE);
  MPI_Waitall(static_cast<int>(requests_->send.size()), requests_->send.data(), MPI_STATUSES_IGNORE);
  requests_->under_way = false;
}

}  // namespace tanktread::ranks
