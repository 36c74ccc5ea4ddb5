// Numbers packed into the bytes of a message, and taken out in the same order by the same program.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace tanktread::ranks {

/// A message being written.
class Packing {
 public:
  template <class Number>
  Packing& put(const Number& number) {
    static_assert(std::is_trivially_copyable_v<Number>);
    append(&number, sizeof number);
    return *this;
  }

  /// Their number goes with them.
  template <class Number>
  Packing& put_all(std::span<const Number> numbers) {
    static_assert(std::is_trivially_copyable_v<Number>);
    put(static_cast<std::uint64_t>(numbers.size()));
    append(numbers.data(), numbers.size_bytes());
    return *this;
  }
  template <class Number>
  Packing& put_all(const std::vector<Number>& numbers) {
    return put_all(std::span<const Number>(numbers));
  }
  Packing& put_text(std::string_view text) {
    return put_all(std::span<const char>(text.data(), text.size()));
  }

  std::span<const std::byte> bytes() const { return bytes_; }
  /// The message, which is then empty.
  std::vector<std::byte> take_bytes() { return std::exchange(bytes_, {}); }

 private:
  void append(const void* from, std::size_t size) {
    if (size == 0) return;
    const auto* first = static_cast<const std::byte*>(from);
    bytes_.insert(bytes_.end(), first, first + size);
  }

  std::vector<std::byte> bytes_;
};

/// A message being read. @throws std::logic_error for more than there is
class Unpacking {
 public:
  explicit Unpacking(std::vector<std::byte> bytes) : bytes_(std::move(bytes)) {}

  template <class Number>
  Number take() {
    Number number;
    std::memcpy(&number, next(sizeof number), sizeof number);
    return number;
  }

  template <class Number>
  std::vector<Number> take_all() {
    std::vector<Number> numbers(take<std::uint64_t>());
    if (!numbers.empty())
      std::memcpy(numbers.data(), next(sizeof(Number) * numbers.size()), sizeof(Number) * numbers.size());
    return numbers;
  }
  std::string take_text() {
    const auto letters = take_all<char>();
    return {letters.begin(), letters.end()};
  }

 private:
  const std::byte* next(std::size_t size) {
    if (size > bytes_.size() - at_)
      throw std::logic_error("a message between ranks is shorter than what is read of it");
    at_ += size;
    return bytes_.data() + at_ - size;
  }

  std::vector<std::byte> bytes_;
  std::size_t at_ = 0;
};

}  // namespace tanktread::ranks
