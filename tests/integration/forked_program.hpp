// The program by a fork of the test program, for tests that call it often.
#pragma once

#include <string>
#include <vector>

namespace tanktread::testing {

/// Runs the program with these arguments to its end, its output in the file `log`. Its environment and folder
/// are those in which the test program began. @return its status, as of waitpid()
int run_forked(const std::vector<std::string>& arguments, const std::string& log);

}  // namespace tanktread::testing
