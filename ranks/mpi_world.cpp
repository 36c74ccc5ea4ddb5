#include "ranks/mpi_world.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <stdexcept>
#include <string>

namespace tanktread::ranks {
namespace {

constexpr int tag = 0;

/// MPI counts with int: calls body(begin, n) for portions of what is larger.
template <class Body>
void for_each_portion(std::size_t size, const Body& body) {
  constexpr std::size_t most = World::most_bytes_at_once;
  for (std::size_t begin = 0; begin < size; begin += most)
    body(begin, static_cast<int>(std::min(most, size - begin)));
}

/// What mpirun and srun tell their processes by. Without it there is one: to begin MPI would take half a
/// second all the same.
bool is_started_by_launcher() {
  const auto names = {"OMPI_COMM_WORLD_SIZE", "PMIX_RANK", "PMI_RANK", "PMI_SIZE"};
  return std::ranges::any_of(names, [](const char* name) { return std::getenv(name) != nullptr; });
}

}  // namespace

World::World(int* argc, char*** argv) : communicator_(std::make_unique<Communicator>()) {
  if (!is_started_by_launcher()) return;
  // Threads of a rank compute; the one that made this speaks.
  int provided = MPI_THREAD_SINGLE;
  if (MPI_Init_thread(argc, argv, MPI_THREAD_FUNNELED, &provided) != MPI_SUCCESS)
    throw std::runtime_error("MPI: cannot begin");
  if (provided < MPI_THREAD_FUNNELED) {
    MPI_Finalize();
    throw std::runtime_error("MPI: this library allows no threads (MPI_THREAD_FUNNELED)");
  }
  MPI_Comm_dup(MPI_COMM_WORLD, &communicator_->all);
  MPI_Comm_rank(communicator_->all, &rank_);
  MPI_Comm_size(communicator_->all, &size_);
}

World::~World() {
  if (!communicator_->began()) return;
  MPI_Comm_free(&communicator_->all);
  MPI_Finalize();
}

const char* World::library() {
  static const std::string name = [] {
    char text[MPI_MAX_LIBRARY_VERSION_STRING];
    int length = 0;
    MPI_Get_library_version(text, &length);
    std::string line(text, static_cast<std::size_t>(length));
    line = line.substr(0, line.find_first_of(",\n"));  // Open MPI says "Open MPI v4.1.4, package: ..."
    for (char& letter : line)
      if (letter == '\t') letter = ' ';  // MPICH says "MPICH Version:\t4.0.2"
    return line;
  }();
  return name.c_str();
}

void World::abort(int exit_code) const {
  if (communicator_->began()) MPI_Abort(communicator_->all, exit_code);
  std::_Exit(exit_code);
}

void World::wait_for_all() const {
  if (communicator_->began()) MPI_Barrier(communicator_->all);
}

double World::highest(double number) const {
  double highest = number;  // a maximum is the same in any order
  if (!communicator_->began()) return highest;
  MPI_Allreduce(&number, &highest, 1, MPI_DOUBLE, MPI_MAX, communicator_->all);
  return highest;
}

void World::send(int rank, std::span<const std::byte> bytes) const {
  const std::uint64_t size = bytes.size();
  MPI_Send(&size, 1, MPI_UINT64_T, rank, tag, communicator_->all);
  for_each_portion(size, [&](std::size_t begin, int n) {
    MPI_Send(bytes.data() + begin, n, MPI_BYTE, rank, tag, communicator_->all);
  });
}

std::vector<std::byte> World::receive(int rank) const {
  std::uint64_t size = 0;
  MPI_Recv(&size, 1, MPI_UINT64_T, rank, tag, communicator_->all, MPI_STATUS_IGNORE);
  std::vector<std::byte> bytes(size);
  for_each_portion(size, [&](std::size_t begin, int n) {
    MPI_Recv(bytes.data() + begin, n, MPI_BYTE, rank, tag, communicator_->all, MPI_STATUS_IGNORE);
  });
  return bytes;
}

}  // namespace tanktread::ranks
