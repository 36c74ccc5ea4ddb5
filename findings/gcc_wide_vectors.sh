#!/usr/bin/env bash
# A vector type that is wider than the processor's registers lives in memory, though it could live in two registers.
#
# Package: g++-12 12.2.0-14+deb12u1. No program is run, only compiled.
#
# A vector of 64 bytes (`vector_size(64)`) is one register with AVX-512. With AVX2 it is computed in two halves, which one would expect to be two
# registers each. GCC keeps each value of such a type in memory: it is written to the stack and read again between any two operations, and a loop
# that is bound by arithmetic becomes twice as slow. With a type of 32 bytes nothing goes through the stack. -Wpsabi warns of
# calls that pass such types, not of this. A lattice Boltzmann step written with 64 bytes had 22 to 35 million nodes a second on an EPYC with AVX2,
# with 32 bytes 43 to 51.
#
# Seen, of a loop of seven sums and five products, vector instructions that touch the stack with -O3 -mavx2:
# | 32 bytes: none
# | 64 bytes: some
# | 64 bytes with -mavx512f: none
#
# What we do: fluid/pack.hpp takes the width of the registers that it is compiled for.
source "$(dirname "$0")/packages.bash"
need g++-12=12.2.0-14+deb12u1

cat >loop.cpp <<'END'
typedef double Vector __attribute__((vector_size(BYTES)));

// Few values: they fit into the sixteen registers of AVX2 as halves too.
void relax(Vector* a, Vector* b, Vector rate, long n) {
  for (long k = 0; k < n; ++k) {
    const Vector sum = a[k] + b[k], difference = a[k] - b[k];
    const Vector change = rate * (sum * sum - difference), other = rate * (difference * sum);
    a[k] += change + other;
    b[k] += change - other;
  }
}
END

# count BYTES OPTIONS: how many instructions of the loop have a vector register and an address on the stack.
count() {
  local bytes=$1
  shift
  g++-12 -O3 "$@" -DBYTES="$bytes" -Wno-psabi -S loop.cpp -o loop.s
  awk '/%[xyz]mm/ && /\(%r[sb]p\)/ { n++ } END { print n + 0 }' loop.s
}
check() {
  local bytes options n
  while read -r bytes options; do
    n=$(count "$bytes" -mavx2 $options)
    echo "$n" >&2
    echo "$bytes bytes${options:+ with $options}: $([ "$n" -eq 0 ] && echo none || echo some)"
  done <<<"32
64
64 -mavx512f"
}
as_seen check
