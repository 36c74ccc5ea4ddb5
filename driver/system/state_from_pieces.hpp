// The state of a fluid, or of a rank's part of it, taken from pieces, however they are cut.
#pragma once

#include <filesystem>
#include <string>

#include "exchange/grid_pieces.hpp"
#include "fluid/fluid.hpp"
#include "ranks/division.hpp"
#include "ranks/packing.hpp"
#include "ranks/world.hpp"

namespace tanktread::driver {

/// The state of a block of the box, as a source for its solver: of pieces as they are written here no more is
/// in memory than is asked for.
class StateFromPieces final : public fluid::StateSource {
 public:
  /// Holds the pieces with nodes of the block against their hashes.
  /// @throws exchange::FileError; std::invalid_argument if they are of another box
  StateFromPieces(const std::filesystem::path& index, const ranks::Triple& box, const ranks::Block& block);

  fluid::StateShape shape() const override { return shape_; }
  /// @throws exchange::FileError
  void read(const std::string& array, fluid::Layers layers, std::span<double> values) const override;

 private:
  StateFromPieces(const std::filesystem::path& file, const exchange::GridIndex& index,
                  const ranks::Block& block);

  fluid::StateShape shape_;
  exchange::GridBlockReader reader_;
};

/// Sets a solver that is not divided to a state in pieces. @throws as StateFromPieces and Fluid::restore_from
void restore_from_pieces(fluid::Fluid& fluid, const std::filesystem::path& index);

/// How a part was restored from pieces.
struct RestoreAnswer {
  std::string error;         ///< "": well, or the error is another rank's
  bool is_of_files = false;  ///< the error is of a file; else the state does not fit
};

void pack(ranks::Packing& packing, const RestoreAnswer& answer);
RestoreAnswer take_restore_answer(ranks::Unpacking& unpacking);

/// Sets a rank's part to the state in pieces. All parts stay as they were if on any rank a piece cannot be
/// read or does not fit; so none waits for a neighbour that stays behind. Together.
RestoreAnswer restore_part(const ranks::World& world, fluid::Fluid& part, const ranks::Division& division,
                           const std::filesystem::path& index);

}  // namespace tanktread::driver
