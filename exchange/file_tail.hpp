// The end of a text file, replaced in place: a file grows by a line without being written anew.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "exchange/descriptor.hpp"

namespace tanktread::exchange {

/// The end of a file that is open for writing.
class FileTail {
 public:
  /// Opens the file and reads its last bytes, at most `most`. @throws FileError if that fails
  FileTail(std::filesystem::path file, std::size_t most);

  /// The last bytes.
  const std::string& text() const { return text_; }

  /// Writes `end` over the last `n_bytes` of the file, all at once, and brings it to the disk. Room is
  /// reserved before: on a full disk nothing is written. Where the file system reserves none, the old end is
  /// put back.
  /// @param end longer than what it replaces
  /// @return false, with nothing done, if a reader holds the file (read_growing_text)
  /// @throws FileError if it cannot be written; the file then is as it was, or the message says that it is
  /// not
  bool replace(std::size_t n_bytes, std::string_view end);

 private:
  void reserve(std::size_t n_bytes) const;
  void write_at(std::int64_t position, std::string_view end) const;
  void put_back(std::int64_t position, int reason) const;

  std::filesystem::path file_;
  Descriptor open_;
  std::int64_t size_ = 0;
  std::string text_;
};

}  // namespace tanktread::exchange
