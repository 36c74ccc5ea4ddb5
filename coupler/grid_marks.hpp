// Which grid nodes are in use, and their numbers in the list of those in use.
#pragma once

#include <bit>
#include <cstdint>
#include <vector>

#include "coupler/coupler.hpp"

namespace tanktread::coupler {

/// A set of grid nodes, one bit a node, that numbers its members in ascending order of their linear index.
/// The cost of a turn (clear, mark, count, number) is that of the rows marked and a look at one byte a row of
/// the grid. Threads may work on ranges of rows at once, as long as no row is in two of them.
///
/// A row is all x of one (y, z); its number is z ny + y. Because members are numbered in ascending order, a
/// run of neighbours in one row has consecutive numbers.
class GridMarks {
 public:
  explicit GridMarks(const Grid& grid);

  /// Rows `begin` to `end` - 1.
  struct Rows {
    std::int64_t begin, end;
  };

  /// Takes the members in these rows out of the set.
  void clear(Rows rows);

  /// The nodes x .. x + count - 1 of any row, made ready for marking; count is 1 to 64.
  struct Run {
    Run(int x, int count)
        : word(x / 64),
          low((~std::uint64_t{0} >> (64 - count)) << (x % 64)),
          high(x % 64 + count > 64 ? ~std::uint64_t{0} >> (128 - x % 64 - count) : 0) {}
    std::int64_t word;        ///< within the row
    std::uint64_t low, high;  ///< bits of that word and of the next
  };

  /// Adds a run to each of `width` rows of the plane z, y = first_y and on, behind the last again 0; it must
  /// not leave the row.
  template <int width>
  void mark(int z, int first_y, const Run& run) {
    const std::int64_t row = rows_before(z) + first_y;
    Word* word = &words_[row * words_per_row_ + run.word];
    std::uint8_t* marked = &row_marked_[row];
#pragma GCC unroll 8
    for (int k = 0; k < width; ++k) {
      if (first_y + k == n_rows_) word -= n_rows_ * words_per_row_, marked -= n_rows_;
      marked[k] = 1;
      word->bits |= run.low;
      if (run.high != 0) word[1].bits |= run.high;
      word += words_per_row_;
    }
  }

  /// The number of members in these rows.
  std::int64_t count(Rows rows) const;

  /// Numbers the members in these rows in ascending order, and lists their linear indices.
  /// @param before members in all rows before; all numbers must be below 2^31
  /// @param nodes where the first of them is listed
  void number(Rows rows, std::int64_t before, std::int64_t* nodes);

  /// The node x of any row, made ready for numbers_of.
  struct Place {
    explicit Place(int x) : word(x / 64), below((std::uint64_t{1} << (x % 64)) - 1) {}
    std::int64_t word;    ///< within the row
    std::uint64_t below;  ///< bits of that word for the nodes before x
  };

  /// The numbers of a member in each of `width` rows, as of mark(). Valid between number() and the next
  /// change of the rows.
  template <int width>
  void numbers_of(int z, int first_y, const Place& place, std::int32_t* numbers) const {
    const Word* word = &words_[(rows_before(z) + first_y) * words_per_row_ + place.word];
#pragma GCC unroll 8
    for (int k = 0; k < width; ++k) {
      if (first_y + k == n_rows_) word -= n_rows_ * words_per_row_;
      numbers[k] = word->before + std::popcount(word->bits & place.below);
      word += words_per_row_;
    }
  }

 private:
  /// 64 nodes of a row: which are members, and how many there are before them (of marked rows only).
  struct Word {
    std::uint64_t bits = 0;
    std::int32_t before = 0;
  };

  std::int64_t rows_before(int z) const {
    return std::int64_t{z} * n_rows_;
  }

  std::int64_t nodes_per_row_, words_per_row_;
  int n_rows_;  ///< of a plane
  std::vector<std::uint8_t> row_marked_;
  std::vector<Word> words_;  // words_per_row_ a row
};

}  // namespace tanktread::coupler
