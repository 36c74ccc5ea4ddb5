#!/usr/bin/env bash
# mpirun of Open MPI ends a second or two late if a process that has ended well returned another exit code than zero.
#
# Package: openmpi-bin, libopenmpi-dev 4.1.4-3+b1 (to be installed: it does not run from another folder).
#
# When a process returns a code that is not zero mpirun ends the others, and gives them a second after each signal. It does so too where all of them have
# been through MPI_Finalize and end by themselves, so that there is nobody to wait for. The exit code is right, only late. A suite of tests that looks at
# exit codes spends most of its time in that, idle. The parameter odls_base_sigkill_timeout=0 (OMPI_MCA_odls_base_sigkill_timeout in the environment)
# takes the wait away.
#
# Seen:
# | exit code 0: 0
# | exit code 0, odls_base_sigkill_timeout=0: 0
# | exit code 2: 2, a second later than exit code 0 or more
# | exit code 2, odls_base_sigkill_timeout=0: 2
#
# What we do: tests/integration/ranks_fixture.py sets the parameter.
source "$(dirname "$0")/packages.bash"
for package in openmpi-bin libopenmpi-dev; do
  dpkg-query -W -f='${Version}' "$package" 2>/dev/null | grep -qxF 4.1.4-3+b1 || cannot_check "$package 4.1.4-3+b1 is not installed"
done

cat >returns.c <<'END'
#include <mpi.h>
#include <stdlib.h>

// The first of the processes returns the code that is given, the others 0.
int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  int rank;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Finalize();
  return rank == 0 ? atoi(argv[1]) : 0;
}
END
mpicc.openmpi returns.c -o returns
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1

# seconds COMMAND ...: sets `code` and `took`, in milliseconds, the least of three.
seconds() {
  local begin now
  took=1000000
  for _ in 1 2 3; do
    begin=$(date +%s%N) code=0
    "$@" >/dev/null 2>&1 || code=$?
    now=$((($(date +%s%N) - begin) / 1000000))
    took=$((now < took ? now : took))
  done
}

check() {
  local exit_code code took least word parameter name
  for exit_code in 0 2; do
    for parameter in "" 0; do
      name=
      if [ -n "$parameter" ]; then
        export OMPI_MCA_odls_base_sigkill_timeout=$parameter
        name=", odls_base_sigkill_timeout=$parameter"
      else
        unset OMPI_MCA_odls_base_sigkill_timeout
      fi
      seconds mpirun.openmpi -n 2 ./returns "$exit_code"
      if [ "$exit_code$parameter" = 0 ]; then least=$took; fi
      word=
      if [ $((took - least)) -gt 800 ]; then word=", a second later than exit code 0 or more"; fi
      echo "exit code $exit_code$name: $code$word"
    done
  done
}
as_seen check
