#!/usr/bin/env bash
# CLI11 takes 64-bit integers that are out of range, and -1 for an unsigned one.
#
# Package: libcli11-dev 2.1.2+ds-1; the program here is built with the machine's g++.
#
# Too large a number for a 32-bit option is an error. For a 64-bit option it becomes the largest or smallest number of the type, and
# the program goes on. An option for std::uint64_t takes -1, which becomes 2^64 - 1; one for std::uint32_t refuses it.
#
# Seen:
# | std::int32_t 99999999999 -> Could not convert: --n = 99999999999
# | std::int64_t 99999999999999999999 -> 9223372036854775807
# | std::int64_t -99999999999999999999 -> -9223372036854775808
# | std::uint64_t 99999999999999999999 -> 18446744073709551615
# | std::uint64_t -1 -> 18446744073709551615
# | std::uint32_t -1 -> Could not convert: --n = -1
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
  const char* large = "99999999999999999999";
  read<std::int32_t>("std::int32_t", "99999999999");
  read<std::int64_t>("std::int64_t", large);
  read<std::int64_t>("std::int64_t", "-99999999999999999999");
  read<std::uint64_t>("std::uint64_t", large);
  read<std::uint64_t>("std::uint64_t", "-1");
  read<std::uint32_t>("std::uint32_t", "-1");
}
END
g++ -std=c++17 check.cpp -o check
as_seen ./check
