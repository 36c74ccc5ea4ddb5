#include "exchange/whole_file.hpp"

#include <fmt/format.h>
#include <sys/file.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <string>
#include <string_view>

#include "exchange/file_kind.hpp"
#include "exchange/vtk_files.hpp"

namespace tanktread::exchange {
namespace {

namespace fs = std::filesystem;
constexpr std::string_view last_element = "</VTKFile>";

/// @return the name, for one that can be opened
const fs::path& require_file(const fs::path& file) {
  std::error_code error;
  if (!fs::exists(file, error)) {
    throw FileError(fmt::format("{}: {}", file.string(),
                                error ? error.message() + "; give another path" : "no such file"));
  }
  if (fs::is_directory(file, error))
    throw FileError(fmt::format("{}: is a folder, not a file", file.string()));
  return file;
}

void require_open(const Descriptor& open, const fs::path& file) {
  if (!open.is_open())
    throw FileError(fmt::format("{}: cannot be read: {}", file.string(), std::strerror(errno)));
}

/// Linux's name of an open file, whatever has become of the name that it was opened by.
fs::path name_of(int descriptor, const fs::path& file) {
  const fs::path name = fmt::format("/proc/self/fd/{}", descriptor);
  std::error_code error;
  return fs::exists(name, error) ? name : file;
}

/// Whether the last element of a text is that of VTK's files.
bool ends_whole(std::string_view text) {
  return text.substr(0, text.find_last_not_of(" \r\n\t") + 1).ends_with(last_element);
}

/// The last bytes of a file, as many as the last element and a few empty lines take; "" if it cannot be read.
std::string end_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary | std::ios::ate);
  if (!stream) return "";
  const auto size = std::min<std::streamoff>(stream.tellg(), 64);
  std::string text(static_cast<std::size_t>(size), '\0');
  stream.seekg(-size, std::ios::end);
  stream.read(text.data(), size);
  return text;
}

/// @param type VTK's type of what it should be
[[noreturn]] void refuse_cut(const fs::path& file, const std::string& type) {
  const auto other = foreign_format(file, file, type);
  if (!other.empty()) throw FileError(fmt::format("{}: {}", file.string(), other));
  throw FileError(
      fmt::format("{}: does not end with {}: it is cut off, or not a VTK XML file; write or copy it again",
                  file.string(), last_element));
}

/// Waits for a writer at work; where the file system knows no locks there is nothing to wait for.
void lock_for_reading(const Descriptor& file) {
  while (::flock(file.number(), LOCK_SH) != 0 && errno == EINTR) {
  }
}

std::string read_all(const Descriptor& open, const fs::path& file) {
  std::string text;
  for (std::size_t step = 1 << 16;;) {
    const auto done = text.size();
    text.resize(done + step);
    const auto n = ::read(open.number(), text.data() + done, step);
    text.resize(done + static_cast<std::size_t>(std::max<ssize_t>(n, 0)));
    if (n < 0 && errno != EINTR)
      throw FileError(fmt::format("{}: cannot be read: {}", file.string(), std::strerror(errno)));
    if (n == 0) return text;
  }
}

}  // namespace

WholeFile::WholeFile(fs::path name, const std::string& type)
    : name_(std::move(name)), open_(require_file(name_), O_RDONLY) {
  require_open(open_, name_);
  content_ = name_of(open_.number(), name_);
  if (!ends_whole(end_of(content_))) refuse_cut(name_, type);
}

std::string read_growing_text(const fs::path& file, const std::string& type) {
  const Descriptor open(require_file(file), O_RDONLY);
  require_open(open, file);
  lock_for_reading(open);
  auto text = read_all(open, file);
  if (!ends_whole(text)) refuse_cut(file, type);
  return text;
}

}  // namespace tanktread::exchange
