#include "exchange/piece_arrays.hpp"

#include <fmt/format.h>

#include "exchange/same_bits.hpp"

namespace tanktread::exchange {

void refuse_piece(const PieceName& name, const std::string& what) {
  throw FileError(
      fmt::format("{}: {}, other than {} says, whose piece it is: they do not belong together; "
                  "write or copy both again",
                  name.piece.string(), what, name.index.string()));
}

void check_numbers_of_whole(const std::vector<Array>& piece, const std::vector<Array>& whole,
                            const PieceName& name) {
  for (const auto& array : whole) {
    const auto* found = find_optional_array(piece, array.name);
    if (found == nullptr || !same_bits(*found, array))
      refuse_piece(name, fmt::format("has another '{}'", array.name));
  }
}

void check_shapes(const std::vector<Array>& piece, const std::vector<ArrayShape>& shapes,
                  const PieceName& name) {
  for (const auto& shape : shapes) {
    const auto* found = find_optional_array(piece, shape.name);
    if (found == nullptr || found->components != shape.components)
      refuse_piece(name, fmt::format("has no array '{}' of {} components", shape.name, shape.components));
  }
}

}  // namespace tanktread::exchange
