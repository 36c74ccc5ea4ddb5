#!/usr/bin/env bash
# CLI11 reads whole numbers of the command line in C's notation: a leading zero makes them octal.
#
# Package: libcli11-dev 2.1.2+ds-1; the program here is built with the machine's g++.
#
# Integers are read with a base of 0, signed and unsigned ones. The step number 0000000100, as it stands in the name of a file, is
# 64; 08 is no number at all. An option for a double reads the same words as decimal numbers.
#
# Seen:
# | std::int64_t 0000000100 -> 64
# | std::int64_t 08 -> Could not convert: --n = 08
# | std::uint64_t 0000000100 -> 64
# | double 0000000100 -> 100
# | double 08 -> 8
#
# What we do: driver/program/number_option.hpp reads the numbers of the command line, and checks them.
source "$(dirname "$0")/packages.bash"
command -v g++ >/dev/null || cannot_check "there is no g++"
need libcli11-dev=2.1.2+ds-1

cat >check.cpp <<'END'
#include <CLI/CLI.hpp>
#include <cstdint>
#include <iostream>
#include <string>
#include <vector>

template <class Number>
void read(const char* type, const char* word) {
  CLI::App app;
  Number n = 0;
  app.add_option("--n", n);
  std::cout << type << ' ' << word << " -> ";
  try {
    app.parse(std::vector<std::string>{word, "--n"});  // CLI11 takes them from the back
    std::cout << n << '\n';
  } catch (const CLI::Error& error) {
    std::cout << error.what() << '\n';
  }
}

int main() {
  for (const char* word : {"0000000100", "08"}) read<std::int64_t>("std::int64_t", word);
  read<std::uint64_t>("std::uint64_t", "0000000100");
  for (const char* word : {"0000000100", "08"}) read<double>("double", word);
}
END
g++ -std=c++17 check.cpp -o check
as_seen ./check
