// Which grid nodes are in use, and their numbers in the list of those in use.
#pragma once

#include <bit>
#include <cstdint>
#include <vector>

#include "coupler/coupler.hpp"

namespace tanktread::coupler {

/// A set of grid nodes, one bit a node, that numbers its members in ascending order of their linear index.
/// The cost of a turn (clear, mark, number) is that of the rows marked and a look at one byte a row of the
/// grid.
///
/// A row is all x of one (y, z); its number is z ny + y. Because members are numbered in ascending order, a
/// run of neighbours in one row has consecutive numbers.
class GridMarks {
 public:
  explicit GridMarks(const Grid& grid);

  /// Empties the set.
  void clear();

  /// The nodes x .. x + count - 1 of any row, made ready for marking; count is 1 to 64.
  struct Run {
    Run(int x, int count)
        : word(x / 64),
          low((~std::uint64_t{0} >> (64 - count)) << (x % 64)),
          high(x % 64 + count > 64 ? ~std::uint64_t{0} >> (128 - x % 64 - count) : 0) {}
    std::int64_t word;        ///< within the row
    std::uint64_t low, high;  ///< bits of that word and of the next
  };

  /// Adds a run of a row; it must not leave the row. Safe to call from several threads as long as no row is
  /// marked by two.
  void mark(std::int64_t row, const Run& run) {
    row_marked_[row] = 1;
    std::uint64_t* bits = &bits_[row * words_per_row_ + run.word];
    bits[0] |= run.low;
    if (run.high != 0) bits[1] |= run.high;
  }

  /// Lists the linear indices of all members, ascending, and numbers them in this order.
  /// @throws std::length_error if there are more than 2^31 - 1
  void number(std::vector<std::int64_t>& nodes);

  /// The node x of any row, made ready for number_of.
  struct Place {
    explicit Place(int x) : word(x / 64), below((std::uint64_t{1} << (x % 64)) - 1) {}
    std::int64_t word;    ///< within the row
    std::uint64_t below;  ///< bits of that word for the nodes before x
  };

  /// The number of a member. Valid between number() and the next change of the set.
  std::int32_t number_of(std::int64_t row, const Place& place) const {
    const std::int64_t word = row * words_per_row_ + place.word;
    return first_number_[word] + std::popcount(bits_[word] & place.below);
  }

 private:
  std::int64_t nodes_per_row_, words_per_row_;
  std::vector<std::uint8_t> row_marked_;
  std::vector<std::uint64_t> bits_;  // words_per_row_ words a row
  std::vector<std::int32_t>
      first_number_;  // a word: members before it; set for the words of marked rows only
};

}  // namespace tanktread::coupler
