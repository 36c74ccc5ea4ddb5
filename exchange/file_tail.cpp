#include "exchange/file_tail.hpp"

#include <fmt/format.h>
#include <sys/file.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "exchange/vtk_files.hpp"

namespace tanktread::exchange {
namespace {

[[noreturn]] void fail(const std::filesystem::path& file, const char* what, int error,
                       const std::string& more = "") {
  throw FileError(fmt::format("{}: {}: {}{}", file.string(), what, std::strerror(error), more));
}

/// Keeps readers out while it lives. Where the file system knows no locks nobody is kept out.
class WriteLock {
 public:
  explicit WriteLock(const Descriptor& file)
      : file_(file),
        is_held_elsewhere_(::flock(file.number(), LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {}
  ~WriteLock() { ::flock(file_.number(), LOCK_UN); }
  WriteLock(const WriteLock&) = delete;
  WriteLock& operator=(const WriteLock&) = delete;

  bool is_held_elsewhere() const { return is_held_elsewhere_; }

 private:
  const Descriptor& file_;
  bool is_held_elsewhere_;
};

}  // namespace

FileTail::FileTail(std::filesystem::path file, std::size_t most)
    : file_(std::move(file)), open_(file_, O_RDWR) {
  if (!open_.is_open()) fail(file_, "cannot be written", errno);
  size_ = ::lseek(open_.number(), 0, SEEK_END);
  text_.resize(std::min(most, static_cast<std::size_t>(std::max<std::int64_t>(size_, 0))));
  const auto length = static_cast<ssize_t>(text_.size());
  if (::pread(open_.number(), text_.data(), text_.size(), size_ - length) != length)
    fail(file_, "cannot be read", errno);
}

bool FileTail::replace(std::size_t n_bytes, std::string_view end) {
  reserve(end.size() - n_bytes);
  {
    const WriteLock lock(open_);
    if (lock.is_held_elsewhere()) return false;
    write_at(size_ - static_cast<std::int64_t>(n_bytes), end);
  }
  if (::fsync(open_.number()) != 0) fail(file_, "cannot be written", errno);
  return true;
}

void FileTail::reserve(std::size_t n_bytes) const {
  if (::fallocate(open_.number(), FALLOC_FL_KEEP_SIZE, size_, static_cast<off_t>(n_bytes)) == 0) return;
  // Any other reason: this file system does not reserve.
  if (errno == ENOSPC || errno == EDQUOT) fail(file_, "cannot be written", errno);
}

void FileTail::write_at(std::int64_t position, std::string_view end) const {
  ssize_t written = -1;
  do {
    written = ::pwrite(open_.number(), end.data(), end.size(), position);
  } while (written < 0 && errno == EINTR);
  if (written != static_cast<ssize_t>(end.size())) put_back(position, written < 0 ? errno : ENOSPC);
}

void FileTail::put_back(std::int64_t position, int reason) const {
  const auto old = std::string_view(text_).substr(text_.size() - static_cast<std::size_t>(size_ - position));
  const bool is_back =
      ::pwrite(open_.number(), old.data(), old.size(), position) == static_cast<ssize_t>(old.size()) &&
      ::ftruncate(open_.number(), size_) == 0;
  fail(file_, "cannot be written", reason, is_back ? "" : "; its end is lost, and could not be put back");
}

}  // namespace tanktread::exchange
