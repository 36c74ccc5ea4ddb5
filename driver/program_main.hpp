// The program as a function, so that tests can have it without starting a process anew.
#pragma once

namespace tanktread::driver {

/// What main() does, on the first rank and on the others. Once a process: it begins and ends MPI.
/// @param argv as that of main() @return the exit code: 0 done, 1 diff found a difference, 2 bad input, 3 a
/// run went wrong, 130/143 signal
int program_main(int argc, char** argv);

}  // namespace tanktread::driver
