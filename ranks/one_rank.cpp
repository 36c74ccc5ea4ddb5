// World and NeighbourMessages of a program without MPI.
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <utility>

#include "ranks/neighbour_messages.hpp"
#include "ranks/world.hpp"

namespace tanktread::ranks {

struct World::Communicator {};
struct NeighbourMessages::Requests {};

World::World(int*, char***) {
  // Each of several would take itself for the only one, and all would do the same work.
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"}) {
    const char* size = std::getenv(name);
    if (size != nullptr && std::atoi(size) > 1)
      throw std::runtime_error(std::string("started as ") + size +
                               " processes, but built without MPI; configure with -DTANKTREAD_MPI=ON");
  }
}
World::~World() = default;

const char* World::library() {
  return "none";
}

void World::abort(int exit_code) const {
  std::_Exit(exit_code);
}

void World::wait_for_all() const {}

double World::highest(double number) const {
  return number;
}

void World::send(int, std::span<const std::byte>) const {
  throw std::logic_error("this program was built without MPI (TANKTREAD_MPI): there is no other rank");
}

std::vector<std::byte> World::receive(int) const {
  throw std::logic_error("this program was built without MPI (TANKTREAD_MPI): there is no other rank");
}

std::vector<Message> World::exchange(std::vector<Message> outgoing) const {
  for (const auto& message : outgoing) {
    if (message.rank != rank_)
      throw std::logic_error("this program was built without MPI (TANKTREAD_MPI): there is no other rank");
  }
  return outgoing;
}

std::vector<Message> World::exchange(std::vector<Message> outgoing, std::span<const int>) const {
  return exchange(std::move(outgoing));
}

std::vector<double> World::all_numbers(std::span<const double> numbers) const {
  return {numbers.begin(), numbers.end()};
}

NeighbourMessages::NeighbourMessages(const World&, const Division&,
                                     std::span<const NeighbourMessage> messages) {
  if (!messages.empty())
    throw std::logic_error("this program was built without MPI (TANKTREAD_MPI): it has no neighbours");
}
NeighbourMessages::~NeighbourMessages() = default;

void NeighbourMessages::start() {}
void NeighbourMessages::finish() {}

}  // namespace tanktread::ranks
