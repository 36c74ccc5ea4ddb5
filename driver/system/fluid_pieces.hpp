// The fluid of a box that is divided, in files: every rank writes and reads what it has itself.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "driver/case/case_value.hpp"
#include "exchange/grid_pieces.hpp"
#include "fluid/fluid.hpp"
#include "ranks/division.hpp"
#include "ranks/packing.hpp"
#include "ranks/world.hpp"

namespace tanktread::driver {

/// What is to be written in pieces.
struct PiecesOrder {
  std::filesystem::path index;  ///< NAME.pvti; piece K is NAME/K.vti
  Ranges3 range = {};           ///< first and last node of the box
  bool is_state = false;        ///< the state of the solver; else the flow, to be looked at
  std::int64_t step = 0;
  double shear_time = 0;
};

void pack(ranks::Packing& packing, const PiecesOrder& what);
PiecesOrder take_pieces_order(ranks::Unpacking& unpacking);

/// What one rank has of a divided fluid. All is borrowed.
struct FluidPart {
  const ranks::World& world;
  const ranks::Division& division;
  const fluid::Fluid& fluid;             ///< the rank's part
  double base_viscosity = 0;             ///< of nodes that have none of their own
  std::span<const std::int32_t> inside;  ///< marks of the part's nodes; empty: none
};

/// How the writing of a piece ended.
struct PieceWritten {
  std::string error;  ///< "": all is well
  /// What every piece has.
  std::vector<exchange::ArrayShape> point_data;
  std::vector<exchange::Array> field_data;
};

/// Writes the rank's piece, if it has any cells of the range: its nodes there, and where the range goes on
/// beyond it one layer more, which it gets from its neighbours. Beside the fluid there are some layers in
/// memory, and the nodes at the cuts. Together.
PieceWritten write_piece(const FluidPart& part, const PiecesOrder& what);

/// Writes the index, after all ranks have written their pieces. @throws exchange::FileError
void write_index(const ranks::Division& division, const PiecesOrder& what, const PieceWritten& pieces);

/// Writes all of a fluid that is not divided as the one piece of an index. @param inside marks of the nodes;
/// empty: none
/// @throws exchange::FileError
void write_as_one_piece(const fluid::Fluid& fluid, std::span<const std::int32_t> inside,
                        const PiecesOrder& what);

/// All nodes of a box.
Ranges3 whole_range(const ranks::Triple& box);

/// The folder of the pieces of an index, beside it.
std::filesystem::path folder_of_pieces(const std::filesystem::path& index);

}  // namespace tanktread::driver
