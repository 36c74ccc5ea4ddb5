#include "driver/outside/packet_directory.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>

#include "driver/program/errors.hpp"

namespace tanktread::driver {
namespace {

namespace fs = std::filesystem;

fs::path fresh_directory() {
  const fs::path in_memory = "/dev/shm";
  std::error_code error;
  const bool has_memory = fs::is_directory(in_memory, error) && ::access(in_memory.c_str(), W_OK) == 0;
  auto name = ((has_memory ? in_memory : fs::temp_directory_path()) / "tanktread-XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr) {
    throw InputError(
        fmt::format("{}: no directory for the packets of a program can be made: {}; give "
                    "run.command_directory",
                    name, std::strerror(errno)));
  }
  return name;
}

}  // namespace

PacketDirectory::PacketDirectory(const std::string& place, const std::string& name) {
  if (place.empty()) {
    path_ = fresh_directory();
  } else {
    path_ = fs::path(place) / name;
    lock_ = std::make_unique<DirectoryLock>(path_);
  }
}

PacketDirectory::~PacketDirectory() {
  std::error_code ignored;  // nothing more can be done about it, and a destructor must not throw
  if (!lock_) fs::remove_all(path_, ignored);
}

fs::path PacketDirectory::next_file(const std::string& extension) {
  turn_ = 1 - turn_;
  return path_ / fmt::format("input_{}{}", turn_, extension);
}

}  // namespace tanktread::driver
