#!/usr/bin/env bash
# A program with OpenMP becomes many times slower as soon as other programs compute on the same machine.
#
# Package: libgomp1 12.2.0-14+deb12u1; the program here is built with the machine's g++. It keeps all cores busy for 5 to 20 seconds.
#
# At the end of each parallel loop the threads of libgomp wait for each other by spinning. While each has a core to itself that is
# fast. If something else runs too, a thread that spins holds the core that the one it waits for would need, and a loop of some
# microseconds takes as long as the system's time slices. OMP_WAIT_POLICY=passive makes threads sleep at once. libgomp reads its variables
# when it is loaded: a program cannot set them for itself in main(). How much slower it gets varies from run to run (7 to 110 times here).
#
# With more threads of OpenMP than cores libgomp spins for a short time only, also where the others belong
# to another team, and sleep.
#
# Seen, on two cores: 4000 loops with 2 threads beside 2 busy programs: 11.8248 s, with OMP_WAIT_POLICY=passive 0.1554 s, beside a team that sleeps 0.2575 s
# | more than three times as long as with passive waiting
# | the same beside a team that sleeps: no
# | variables set in main() count: no
#
# What we do: driver/program/waiting_threads.hpp adds threads that sleep while other programs share the cores.
source "$(dirname "$0")/packages.bash"
command -v g++ >/dev/null || cannot_check "there is no g++"
need libgomp1=12.2.0-14+deb12u1
n=$(nproc)
[ "$n" -ge 2 ] || cannot_check "there is one core only"

cat >check.cpp <<'END'
#include <omp.h>

#include <cstdio>
#include <cstdlib>
#include <future>
#include <string>
#include <thread>
#include <vector>

// As many threads of OpenMP as there are cores; it ends as they sleep.
void team() {
#pragma omp parallel
  asm volatile("");
}

// The seconds that short parallel loops take; with "team" beside a team that sleeps. With "set" whether libgomp still looks at its
// variables.
int main(int argc, char** argv) {
  const std::string what = argc > 1 ? argv[1] : "";
  std::promise<void> begun, done;
  std::thread first;
  if (what == "team") {
    first = std::thread([&] {
      team();
      begun.set_value();
      done.get_future().wait();
    });
    begun.get_future().wait();
  }
  if (what == "set") {
    const int before = omp_get_max_threads();
    setenv("OMP_NUM_THREADS", before == 1 ? "2" : "1", 1);
    std::printf("variables set in main() count: %s\n", omp_get_max_threads() == before ? "no" : "yes");
    return 0;
  }
  std::vector<double> a(20000, 1.0);
  const double start = omp_get_wtime();
  for (int step = 0; step < 500; ++step) {
#pragma omp parallel for schedule(static)
    for (std::size_t i = 0; i < a.size(); ++i) a[i] = 0.999 * a[i] + 0.001;
  }
  std::printf("%.4f\n", omp_get_wtime() - start);
  done.set_value();
  if (first.joinable()) first.join();
}
END
g++ -O2 -fopenmp check.cpp -o check

# The sum of some runs each, by turns, beside a busy loop for each core.
busy=()
for ((k = 0; k < n; ++k)); do
  timeout 120 "$python" -c 'while True: pass' &
  busy+=($!)
done
by_default=0 passive=0 team=0
for _ in 1 2 3 4 5 6 7 8; do
  by_default=$(awk "BEGIN { print $by_default + $(./check) }")
  passive=$(awk "BEGIN { print $passive + $(OMP_WAIT_POLICY=passive ./check) }")
  team=$(awk "BEGIN { print $team + $(./check team) }")
done
kill "${busy[@]}"
wait "${busy[@]}" 2>/dev/null || true
echo "4000 loops with $n threads beside $n busy programs: $by_default s, with OMP_WAIT_POLICY=passive $passive s, beside a team that sleeps $team s"
check() {
  awk "BEGIN { print (($by_default > 3 * $passive) ? \"more than three times\" : \"about\") \" as long as with passive waiting\" }"
  awk "BEGIN { print \"the same beside a team that sleeps: \" (($team > 3 * $passive) ? \"yes\" : \"no\") }"
  ./check set
}
as_seen check
