#include "coupler/grid_marks.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace tanktread::coupler {

GridMarks::GridMarks(const Grid& grid)
    : nodes_per_row_(grid.nodes[0]),
      words_per_row_((grid.nodes[0] + 63) / 64),
      row_marked_(std::size_t{1} * grid.nodes[1] * grid.nodes[2], 0),
      bits_(row_marked_.size() * words_per_row_, 0),
      first_number_(bits_.size(), 0) {}

void GridMarks::clear() {
  for (std::size_t row = 0; row < row_marked_.size(); ++row) {
    if (!row_marked_[row]) continue;
    std::fill_n(bits_.begin() + row * words_per_row_, words_per_row_, 0);
    row_marked_[row] = 0;
  }
}

void GridMarks::number(std::vector<std::int64_t>& nodes) {
  std::int64_t count = 0;
  for (std::size_t row = 0; row < row_marked_.size(); ++row) {
    if (!row_marked_[row]) continue;
    for (std::size_t word = row * words_per_row_; word < (row + 1) * words_per_row_; ++word) {
      first_number_[word] = static_cast<std::int32_t>(count);
      count += std::popcount(bits_[word]);
    }
    if (count > std::numeric_limits<std::int32_t>::max())
      throw std::length_error("coupler: the stencils touch more than 2^31 - 1 grid nodes");
  }
  nodes.resize(count);
  auto node = nodes.begin();
  for (std::size_t row = 0; row < row_marked_.size(); ++row) {
    if (!row_marked_[row]) continue;
    for (std::int64_t word = 0; word < words_per_row_; ++word) {
      const std::int64_t first = row * nodes_per_row_ + 64 * word;
      for (std::uint64_t left = bits_[row * words_per_row_ + word]; left != 0; left &= left - 1)
        *node++ = first + std::countr_zero(left);
    }
  }
}

}  // namespace tanktread::coupler
