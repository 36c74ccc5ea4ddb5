#include "exchange/atomic_file.hpp"

#include <fmt/format.h>

#include <atomic>
#include <cerrno>
#include <cstring>

#include "exchange/descriptor.hpp"
#include "exchange/vtk_files.hpp"

namespace tanktread::exchange {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& file, const char* what, int error) {
  throw FileError(fmt::format("{}: {}: {}", file.string(), what, std::strerror(error)));
}

fs::path folder_of(const fs::path& file) {
  return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

void write_all(const Descriptor& file, const std::string& text, const fs::path& target) {
  for (std::size_t done = 0; done < text.size();) {
    const auto written = ::write(file.number(), text.data() + done, text.size() - done);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) fail(target, "cannot be written", written < 0 ? errno : ENOSPC);
    done += static_cast<std::size_t>(written);
  }
}

/// The file that a link stands for: the rename would replace the link, and leave that file as it is.
fs::path behind_links(const fs::path& target) {
  std::error_code error;
  if (!fs::is_symlink(target, error)) return target;
  if (fs::exists(target, error) && !fs::is_regular_file(target, error)) return target;  // refused as it is
  auto file = fs::canonical(target, error);
  if (!error) return file;
  throw FileError(fmt::format(
      "{}: cannot be written: it is a link to a file that is not there; give another name", target.string()));
}

}  // namespace

AtomicFile::AtomicFile(fs::path target) : target_(behind_links(target)) {
  const auto folder = folder_of(target_);
  std::error_code error;
  if (!fs::is_directory(folder, error)) {
    throw FileError(fmt::format("{}: cannot be written: there is no folder '{}'; make it first",
                                target_.string(), folder.string()));
  }
  if (fs::is_directory(target_, error)) {
    throw FileError(fmt::format("{}: cannot be written: it is a folder", target_.string()));
  }
  // The rename would put a file in the place of /dev/null, for all programs of the machine.
  if (fs::exists(target_, error) && !fs::is_regular_file(target_, error)) {
    throw FileError(fmt::format("{}: cannot be written: it is a device or a pipe; give the name of a file",
                                target_.string()));
  }
  static std::atomic<unsigned> counter = 0;
  temporary_ = folder / fmt::format(".{}.{}-{}.tmp", target_.filename().string(), ::getpid(), counter++);
}

AtomicFile::~AtomicFile() {
  std::error_code ignored;  // nothing more can be done about it, and a destructor must not throw
  if (!committed_) fs::remove(temporary_, ignored);
}

void AtomicFile::commit() {
  {
    // Without this a power cut after the rename could leave an empty file under the final name.
    const Descriptor file(temporary_, O_RDWR);
    if (!file.is_open() || ::fsync(file.number()) != 0) fail(target_, "cannot be written", errno);
  }
  if (::rename(temporary_.c_str(), target_.c_str()) != 0) fail(target_, "cannot be replaced", errno);
  committed_ = true;
  // The rename itself reaches the disk with the folder; some file systems refuse that for folders, and need
  // it not.
  const Descriptor folder(folder_of(target_), O_RDONLY | O_DIRECTORY);
  if (folder.is_open()) ::fsync(folder.number());
}

void write_text(const fs::path& file, const std::string& text) {
  AtomicFile atomic(file);
  {
    const Descriptor temporary(atomic.temporary(), O_WRONLY | O_CREAT | O_EXCL);
    if (!temporary.is_open()) fail(file, "cannot be written", errno);
    write_all(temporary, text, file);
  }
  atomic.commit();
}

void append_text(const fs::path& file, const std::string& text) {
  const Descriptor open(file, O_WRONLY | O_APPEND);
  if (!open.is_open()) fail(file, "cannot be written", errno);
  const auto size = ::lseek(open.number(), 0, SEEK_END);
  try {
    write_all(open, text, file);
  } catch (const FileError&) {
    if (::ftruncate(open.number(), size) != 0)
      fail(file, "its end is lost, and could not be put back", errno);
    throw;
  }
}

}  // namespace tanktread::exchange
