#include "ranks/mpi_world.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <stdexcept>
#include <string>

namespace tanktread::ranks {

World::World(int* argc, char*** argv) : communicator_(std::make_unique<Communicator>()) {
  int began = 0;
  MPI_Initialized(&began);
  if (!began) {
    // Threads of a rank compute; the one that made this speaks.
    int provided = MPI_THREAD_SINGLE;
    if (MPI_Init_thread(argc, argv, MPI_THREAD_FUNNELED, &provided) != MPI_SUCCESS)
      throw std::runtime_error("MPI: cannot begin");
    communicator_->began = true;
    if (provided < MPI_THREAD_FUNNELED) {
      MPI_Finalize();
      throw std::runtime_error("MPI: this library allows no threads (MPI_THREAD_FUNNELED)");
    }
  }
  MPI_Comm_dup(MPI_COMM_WORLD, &communicator_->all);
  MPI_Comm_rank(communicator_->all, &rank_);
  MPI_Comm_size(communicator_->all, &size_);
}

World::~World() {
  MPI_Comm_free(&communicator_->all);
  if (communicator_->began) MPI_Finalize();
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
  MPI_Abort(communicator_->all, exit_code);
  std::abort();  // never reached
}

void World::wait_for_all() const {
  MPI_Barrier(communicator_->all);
}

double World::highest(double number) const {
  double highest = number;  // a maximum is the same in any order
  MPI_Allreduce(&number, &highest, 1, MPI_DOUBLE, MPI_MAX, communicator_->all);
  return highest;
}

std::vector<std::byte> World::gather(std::span<const std::byte> bytes) const {
  // In portions, for MPI counts with int.
  constexpr std::size_t portion = std::size_t{1} << 28;
  constexpr int tag = 27;  // above those of the directions
  const MPI_Comm all = communicator_->all;
  std::uint64_t size = bytes.size();
  if (!is_first()) {
    MPI_Send(&size, 1, MPI_UINT64_T, 0, tag, all);
    for (std::size_t at = 0; at < size; at += portion)
      MPI_Send(bytes.data() + at, static_cast<int>(std::min(portion, bytes.size() - at)), MPI_BYTE, 0, tag,
               all);
    return {};
  }
  std::vector<std::byte> gathered(bytes.begin(), bytes.end());
  for (int rank = 1; rank < size_; ++rank) {
    MPI_Recv(&size, 1, MPI_UINT64_T, rank, tag, all, MPI_STATUS_IGNORE);
    const std::size_t begin = gathered.size();
    gathered.resize(begin + size);
    for (std::size_t at = 0; at < size; at += portion)
      MPI_Recv(gathered.data() + begin + at, static_cast<int>(std::min<std::size_t>(portion, size - at)),
               MPI_BYTE, rank, tag, all, MPI_STATUS_IGNORE);
  }
  return gathered;
}

}  // namespace tanktread::ranks
