#include "coupler/grid_marks.hpp"

#include <algorithm>

namespace tanktread::coupler {

GridMarks::GridMarks(const Grid& grid)
    : nodes_per_row_(grid.nodes[0]),
      words_per_row_((grid.nodes[0] + 63) / 64),
      n_rows_(grid.nodes[1]),
      row_marked_(std::size_t{1} * grid.nodes[1] * grid.nodes[2], 0),
      words_(row_marked_.size() * words_per_row_) {}

void GridMarks::clear(Rows rows) {
  for (std::int64_t row = rows.begin; row < rows.end; ++row) {
    if (!row_marked_[row]) continue;
    std::fill_n(words_.begin() + row * words_per_row_, words_per_row_, Word{});
    row_marked_[row] = 0;
  }
}

std::int64_t GridMarks::count(Rows rows) const {
  std::int64_t count = 0;
  for (std::int64_t row = rows.begin; row < rows.end; ++row) {
    if (!row_marked_[row]) continue;
    for (std::int64_t word = 0; word < words_per_row_; ++word)
      count += std::popcount(words_[row * words_per_row_ + word].bits);
  }
  return count;
}

void GridMarks::number(Rows rows, std::int64_t before, std::int64_t* nodes) {
  for (std::int64_t row = rows.begin; row < rows.end; ++row) {
    if (!row_marked_[row]) continue;
    for (std::int64_t k = 0; k < words_per_row_; ++k) {
      Word& word = words_[row * words_per_row_ + k];
      word.before = static_cast<std::int32_t>(before);
      before += std::popcount(word.bits);
      const std::int64_t first = row * nodes_per_row_ + 64 * k;
      // Run after run of neighbours: a loop over single bits would wait for each.
      for (std::uint64_t left = word.bits; left != 0;) {
        const int begin = std::countr_zero(left), length = std::countr_one(left >> begin);
        for (int x = begin; x < begin + length; ++x) *nodes++ = first + x;
        left = begin + length == 64 ? 0 : left & (~std::uint64_t{0} << (begin + length));
      }
    }
  }
}

}  // namespace tanktread::coupler
