// An open file of the operating system.
#pragma once

#include <fcntl.h>
#include <unistd.h>

#include <filesystem>

namespace tanktread::exchange {

/// An open file that closes itself.
class Descriptor {
 public:
  /// As open(2) does, never to be passed on to a program that is started; is_open() says whether it
  /// succeeded, errno why not.
  Descriptor(const std::filesystem::path& file, int flags)
      : number_(::open(file.c_str(), flags | O_CLOEXEC, 0666)) {}
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  bool is_open() const { return number_ >= 0; }
  int number() const { return number_; }

 private:
  int number_;
};

}  // namespace tanktread::exchange
