// What World holds with MPI. Internal to ranks/.
#pragma once

#include <mpi.h>

#include "ranks/world.hpp"

namespace tanktread::ranks {

/// Of our own, so that no message meets one of a library.
struct World::Communicator {
  MPI_Comm all = MPI_COMM_NULL;
  bool began() const { return all != MPI_COMM_NULL; }
  bool is_odd_exchange = false;  ///< among ranks that do not know of each other
};

}  // namespace tanktread::ranks
