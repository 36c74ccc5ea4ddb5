#!/usr/bin/env bash
# What an element of a loop becomes depends on how many elements the loop is given, though none depends on another.
#
# Package: g++-12 12.2.0-14+deb12u1. The processor needs FMA (x86-64-v3).
#
# GCC fuses a product and a sum by default (-ffp-contract=fast), which rounds once instead of twice; so a result depends on the compiler. It also
# depends on the place in the array: a loop takes several elements at a time, and those that are left at the end one by one, and the two need not
# fuse alike. Here the branches of a condition have a product in common. Several at a time have no branches (this needs
# -fno-trapping-math), and the product is fused; one by one it is taken out of both branches first, and rounded. So a quarter of the
# elements are one bit off if they are asked for alone, and a program that cuts an array among threads or processes has other results for other cuts.
#
# Seen, of 8000 elements, whether those of arrays of eight are those of arrays of one:
# | -O3 -march=x86-64-v3 -fno-trapping-math: some differ
# | -O3 -march=x86-64-v3 -fno-trapping-math -ffp-contract=off: all alike
# | -O3 -march=x86-64-v3: all alike
#
# What we do: coupler/kernels.cpp says by std::fma what is fused where this was met (slopes of peskin4), its tests ask for other numbers of elements
# at once; fluid/ and what does not take the time of a step are compiled with -ffp-contract=off.
source "$(dirname "$0")/packages.bash"
need g++-12=12.2.0-14+deb12u1

cat >loop.cpp <<'END'
#include <cstdio>
#include <cstdlib>

__attribute__((noinline)) void evaluate(int n, const double* x, double* y) {
  for (int k = 0; k < n; ++k) y[k] = x[k] <= 0.5 ? 1.0 - 3.0 * x[k] * x[k] : 3.0 - 3.0 * x[k] * x[k];
}

int main() {
  int n_different = 0;
  for (int round = 0; round < 1000; ++round) {
    double x[8], together[8], alone;
    for (double& number : x) number = std::rand() / (RAND_MAX + 1.0);
    evaluate(8, x, together);
    for (int k = 0; k < 8; ++k) {
      evaluate(1, &x[k], &alone);
      n_different += alone != together[k];
    }
  }
  std::printf("%d\n", n_different);
}
END

check() {
  local options n
  while read -r options; do
    g++-12 $options loop.cpp -o loop
    n=$(./loop)
    echo "$n" >&2
    echo "$options: $([ "$n" -eq 0 ] && echo all alike || echo some differ)"
  done <<<"-O3 -march=x86-64-v3 -fno-trapping-math
-O3 -march=x86-64-v3 -fno-trapping-math -ffp-contract=off
-O3 -march=x86-64-v3"
}
as_seen check
