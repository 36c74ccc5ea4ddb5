// Bytes as a file, for readers that take a name.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace tanktread::fuzz {

/// A file in memory alone, which can be read but not replaced; gone with the object.
class InputFile {
 public:
  explicit InputFile(std::string_view bytes);
  ~InputFile();
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  int descriptor_;
  std::filesystem::path path_;
};

/// A folder of this process, empty at first and gone with the object.
class WorkFolder {
 public:
  WorkFolder();
  ~WorkFolder();
  WorkFolder(const WorkFolder&) = delete;
  WorkFolder& operator=(const WorkFolder&) = delete;
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

void put_bytes(const std::filesystem::path& file, std::string_view bytes);
std::string bytes_of(const std::filesystem::path& file);

}  // namespace tanktread::fuzz
