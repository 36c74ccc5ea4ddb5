// The runs of grid nodes inside one closed surface, row by row. Internal to the coupler.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "coupler/coupler.hpp"
#include "coupler/inside.hpp"

namespace tanktread::coupler {

/// Nodes begin .. end - 1 (linear indices in the grid) of one row.
struct InsideRun {
  std::int64_t begin, end;
  std::int32_t mark;   ///< number of the surface, plus 1
  std::int32_t plane;  ///< z, in the part
};

/// Numbers begin .. end - 1, of nodes along an axis; not wrapped into the grid.
struct AxisRange {
  int begin = 0, end = 0;
};

/// What an InsideError says, in the order in which they are looked for.
enum class InsideFault { surface, row, overlap };

/// InsideError::precedence.
/// @param number of the surface @param place its row; of an overlap, `number` is the node and this 0
inline std::uint64_t precedence_of(InsideFault fault, std::uint64_t number, std::uint64_t place = 0) {
  return static_cast<std::uint64_t>(fault) << 62 | (fault == InsideFault::row ? number << 38 : number) |
         place;
}

/// A surface as seen from the rows of nodes along x.
struct RowSurface {
  struct Node {
    double x, y, z;
    int plane;  ///< the first plane of grid nodes that is not below it
  };

  /// Takes in what it needs of the surface, wrapped by whole periods so that its least coordinates are in the
  /// grid. That is exact but for coordinates below 0, which lose what rounding takes off them in the grid.
  /// @param surface its number, for messages
  /// @throws InsideError, std::invalid_argument as InsideMarks::mark()
  void take_in(const Grid& grid, int surface, std::span<const double> positions,
               std::span<const int> triangles);

  /// Of a row not wrapped, counted through all those of all its planes.
  std::uint64_t row_number(int y, int z) const {
    return std::uint64_t{1} * (z - planes.begin) * (rows.end - rows.begin) + (y - rows.begin);
  }

  int number = 0;
  std::vector<Node> nodes;
  std::span<const int> triangles;
  /// Nodes along x, rows and planes that may meet it: x, y and z; between the walls, where there are any.
  AxisRange columns, rows, planes;
};

/// Some neighbouring rows of a surface in some neighbouring planes.
struct RowBlock {
  const RowSurface* surface;
  AxisRange rows, planes;
};

/// Adds the blocks of rows that a part has of a surface: one, but across periodic faces.
void add_blocks(const Grid& grid, const GridPart& part, const RowSurface& surface,
                std::vector<RowBlock>& blocks);

/// The runs inside a surface in a block of its rows.
class RowScan {
 public:
  /// Finds them anew. Rows are looked at in ascending order, up to the first that is wrong.
  /// @param part of which the block is; runs outside of it are left out
  void find(const Grid& grid, const GridPart& part, const RowBlock& block);

  /// In the order of the rows not wrapped, each within the grid.
  std::span<const InsideRun> runs() const { return runs_; }
  /// What is wrong with the surface, if anything is.
  const std::optional<InsideError>& fault() const { return fault_; }

 private:
  /// Where a row meets the surface.
  struct Crossing {
    double x;
    std::int32_t row;  ///< counted through all rows of the planes
    bool leaving;      ///< going along x
  };
  /// A row not wrapped.
  struct Row {
    int y, z;
  };

  void cross(const RowBlock& block);
  void cross(const std::array<const RowSurface::Node*, 3>& corners, int plane, AxisRange rows, int first_row);
  void sort_by_row(std::size_t n_rows);
  void fill(const Grid& grid, const GridPart& part, const RowSurface& surface, Row row,
            std::span<Crossing> crossings);
  void add(const Grid& grid, const GridPart& part, const RowSurface& surface, Row row, AxisRange nodes);

  std::vector<Crossing> found_, crossings_;  ///< as found, and row by row
  std::vector<std::size_t> next_in_row_;     ///< where the next crossing of each row goes to
  std::vector<InsideRun> runs_;
  std::optional<InsideError> fault_;
};

}  // namespace tanktread::coupler
