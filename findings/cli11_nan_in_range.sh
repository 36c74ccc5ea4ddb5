#!/usr/bin/env bash
# CLI11's checks of a range let nan through.
#
# Package: libcli11-dev 2.1.2+ds-1; the program here is built with the machine's g++.
#
# CLI::Range refuses a number that is below the lower or above the upper limit, and nan is neither. CLI::PositiveNumber and
# CLI::NonNegativeNumber are such ranges too. So an option that is declared as a positive number gives nan to the program, and what
# follows from it: comparisons that are false, a loop that does not end.
#
# Seen:
# | Range(0.0, 1.0) 1.5 -> refused
# | Range(0.0, 1.0) nan -> nan
# | PositiveNumber -1 -> refused
# | PositiveNumber inf -> refused
# | PositiveNumber nan -> nan
# | NonNegativeNumber nan -> nan
#
# What we do: driver/program/number_option.hpp reads the numbers of the command line, and checks them.
source "$(dirname "$0")/packages.bash"
command -v g++ >/dev/null || cannot_check "there is no g++"
need libcli11-dev=2.1.2+ds-1

cat >check.cpp <<'END'
#include <CLI/CLI.hpp>
#include <iostream>
#include <string>
#include <vector>

void read(const char* name, const CLI::Validator& check, const char* word) {
  CLI::App app;
  double n = 0;
  app.add_option("--n", n)->check(check);
  std::cout << name << ' ' << word << " -> ";
  try {
    app.parse(std::vector<std::string>{word, "--n"});  // CLI11 takes them from the back
    std::cout << n << '\n';
  } catch (const CLI::ValidationError&) {
    std::cout << "refused\n";
  }
}

int main() {
  for (const char* word : {"1.5", "nan"}) read("Range(0.0, 1.0)", CLI::Range(0.0, 1.0), word);
  for (const char* word : {"-1", "inf", "nan"}) read("PositiveNumber", CLI::PositiveNumber, word);
  read("NonNegativeNumber", CLI::NonNegativeNumber, "nan");
}
END
g++ -std=c++17 check.cpp -o check
as_seen ./check
