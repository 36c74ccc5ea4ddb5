// What an index says of the arrays of its pieces, held against a piece. Internal to exchange/.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "exchange/array_shape.hpp"
#include "exchange/packet.hpp"

namespace tanktread::exchange {

/// A piece and the index that names it.
struct PieceName {
  std::filesystem::path piece, index;
};

/// @param what "has ...", of the piece, which the index denies @throws FileError
[[noreturn]] void refuse_piece(const PieceName& name, const std::string& what);

/// @param whole the field data of the index @throws FileError if the piece has not the same among its own
void check_numbers_of_whole(const std::vector<Array>& piece, const std::vector<Array>& whole,
                            const PieceName& name);

/// @throws FileError if the piece lacks one of the arrays
void check_shapes(const std::vector<Array>& piece, const std::vector<ArrayShape>& shapes,
                  const PieceName& name);

}  // namespace tanktread::exchange
