// The memory of this machine, asked before it is tried: a system that runs out of it ends programs without a
// word.
#pragma once

#include <filesystem>
#include <string>

namespace tanktread::driver {

/// Bytes that a program can still have: what the system calls available, or what a control group (container,
/// batch job) leaves of its limit, whichever is less. Caches that can be dropped count as available. Infinity
/// if the system does not say.
/// @param root of the file system, for tests
double available_memory_bytes(const std::filesystem::path& root = "/");

/// Refuses what memory cannot hold.
/// @param what needs it, with file and key: "case.toml: flow.box = [10, 10, 10]"
/// @throws InputError with what is needed, what there is, and the fix
void require_memory(double bytes, const std::string& what, double available = available_memory_bytes());

/// "1.50 GB", "97.3 MB", "2.0 kB".
std::string bytes_text(double bytes);

}  // namespace tanktread::driver
