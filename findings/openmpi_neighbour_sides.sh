#!/usr/bin/env bash
# On a periodic axis of one or two ranks Open MPI's nonblocking neighbour collective exchanges the sides.
#
# Package: openmpi-bin, libopenmpi-dev 4.1.4-3+b1 (to be installed: it does not run from another folder).
#
# MPI_Neighbor_alltoall and MPI_Ineighbor_alltoall on a Cartesian communicator do the same: a message for each side of each axis, to the lower side first.
# On an axis of one or two ranks the neighbours on both sides are the same rank. The blocking call keeps apart which message went to which side; in the
# nonblocking one each arrives as if it came from the other side, so that what was said to the right is heard from the right. With three ranks both are
# right. A program that is tested on four ranks or more in a row, and then run on two, exchanges its borders wrongly and says nothing.
#
# Seen:
# | MPI_Ineighbor_alltoall, 1 ranks: the sides are exchanged
# | MPI_Ineighbor_alltoall, 2 ranks: the sides are exchanged
# | MPI_Ineighbor_alltoall, 3 ranks: each from its side
# | MPI_Neighbor_alltoall, 1 ranks: each from its side
# | MPI_Neighbor_alltoall, 2 ranks: each from its side
# | MPI_Neighbor_alltoall, 3 ranks: each from its side
#
# What we do: ranks/mpi_neighbour_messages.cpp sends from point to point, with a tag a direction.
source "$(dirname "$0")/packages.bash"
for package in openmpi-bin libopenmpi-dev; do
  dpkg-query -W -f='${Version}' "$package" 2>/dev/null | grep -qxF 4.1.4-3+b1 || cannot_check "$package 4.1.4-3+b1 is not installed"
done

cat >sides.c <<'END'
#include <mpi.h>
#include <stdio.h>

// Ranks in a periodic row. Each says -1 to the one on its left and 1 to the one on its right.
int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  int n, periodic = 1;
  MPI_Comm_size(MPI_COMM_WORLD, &n);
  MPI_Comm row;
  MPI_Cart_create(MPI_COMM_WORLD, 1, &n, &periodic, 0, &row);
  const int said[2] = {-1, 1};
  int heard[2][2];
  MPI_Neighbor_alltoall(said, 1, MPI_INT, heard[0], 1, MPI_INT, row);
  MPI_Request request;
  MPI_Ineighbor_alltoall(said, 1, MPI_INT, heard[1], 1, MPI_INT, row, &request);
  MPI_Wait(&request, MPI_STATUS_IGNORE);
  int rank;
  MPI_Comm_rank(row, &rank);
  for (int call = 0; call < 2; ++call) {
    // The one on the left has said 1 to its right.
    const int right_way = heard[call][0] == 1 && heard[call][1] == -1;
    int of_all;
    MPI_Reduce(&right_way, &of_all, 1, MPI_INT, MPI_MIN, 0, row);
    if (rank == 0)
      printf("MPI_%s_alltoall, %d ranks: %s\n", call == 0 ? "Neighbor" : "Ineighbor", n,
             of_all ? "each from its side" : "the sides are exchanged");
  }
  MPI_Finalize();
}
END
mpicc sides.c -o sides
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1
check() {
  local n
  for n in 1 2 3; do mpirun -n "$n" ./sides; done | sort
}
as_seen check
