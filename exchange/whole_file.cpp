#include "exchange/whole_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <string>
#include <string_view>

#include "exchange/vtk_files.hpp"

namespace tanktread::exchange {
namespace {

namespace fs = std::filesystem;
constexpr std::string_view last_element = "</VTKFile>";

int open_to_read(const fs::path& file) {
  std::error_code error;
  if (!fs::exists(file, error)) throw FileError(fmt::format("{}: no such file", file.string()));
  if (fs::is_directory(file, error))
    throw FileError(fmt::format("{}: is a folder, not a file", file.string()));
  const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0)
    throw FileError(fmt::format("{}: cannot be read: {}", file.string(), std::strerror(errno)));
  return descriptor;
}

/// Linux's name of an open file, whatever has become of the name that it was opened by.
fs::path name_of(int descriptor, const fs::path& file) {
  const fs::path name = fmt::format("/proc/self/fd/{}", descriptor);
  std::error_code error;
  return fs::exists(name, error) ? name : file;
}

/// Whether the file's last element is that of VTK's files.
bool ends_whole(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary | std::ios::ate);
  if (!stream) return false;
  const auto size = std::min<std::streamoff>(stream.tellg(), 64);
  std::string text(static_cast<std::size_t>(size), '\0');
  stream.seekg(-size, std::ios::end);
  stream.read(text.data(), size);
  text.erase(text.find_last_not_of(" \r\n\t") + 1);
  return text.ends_with(last_element);
}

}  // namespace

WholeFile::WholeFile(fs::path name) : name_(std::move(name)), descriptor_(open_to_read(name_)) {
  content_ = name_of(descriptor_, name_);
  if (!ends_whole(content_)) {
    ::close(descriptor_);
    throw FileError(
        fmt::format("{}: does not end with {}: it is cut off, or not a VTK XML file; write or copy it again",
                    name_.string(), last_element));
  }
}

WholeFile::~WholeFile() {
  ::close(descriptor_);
}

}  // namespace tanktread::exchange
