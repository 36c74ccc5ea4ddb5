// The runs of grid nodes inside one closed surface, row by row. Internal to the coupler.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "coupler/coupler.hpp"

namespace tanktread::coupler {

/// Grid nodes begin .. end - 1 (linear indices) of one row.
struct InsideRun {
  std::int64_t begin, end;
  std::int32_t mark;   ///< number of the surface, plus 1
  std::int32_t plane;  ///< z
};

/// Numbers begin .. end - 1, of nodes along an axis; not wrapped into the grid.
struct AxisRange {
  int begin = 0, end = 0;
};

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

  int number = 0;
  std::vector<Node> nodes;
  std::span<const int> triangles;
  AxisRange rows, planes;  ///< those that may meet it: y and z; between the walls, where there are any
};

/// The runs inside a surface in some of its planes.
class RowScan {
 public:
  /// Finds them anew. Rows are looked at in ascending order, up to the first that is wrong.
  void find(const Grid& grid, const RowSurface& surface, AxisRange planes);

  /// In the order of the rows not wrapped, each within the grid.
  std::span<const InsideRun> runs() const { return runs_; }
  /// What is wrong with the surface; empty: nothing.
  const std::string& fault() const { return fault_; }

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

  void cross(const RowSurface& surface, AxisRange planes);
  void cross(const RowSurface& surface, const std::array<const RowSurface::Node*, 3>& corners, int plane,
             int first_row);
  void sort_by_row(std::size_t n_rows);
  void fill(const Grid& grid, const RowSurface& surface, Row row, std::span<Crossing> crossings);
  void add(const Grid& grid, const RowSurface& surface, Row row, AxisRange nodes);

  std::vector<Crossing> found_, crossings_;  ///< as found, and row by row
  std::vector<std::size_t> next_in_row_;     ///< where the next crossing of each row goes to
  std::vector<InsideRun> runs_;
  std::string fault_;
};

}  // namespace tanktread::coupler
