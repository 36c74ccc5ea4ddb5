// Where populations lie in memory, and where each finds its neighbour: the in-place (AA) update.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <new>
#include <optional>

#include "fluid/d3q19.hpp"
#include "fluid/fluid.hpp"
#include "fluid/halo.hpp"
#include "fluid/lattice_boltzmann.hpp"
#include "fluid/part_border.hpp"

namespace tanktread::fluid {

/// The two kinds of step that follow each other in turn, the even (local) and the odd (streaming) steps of
/// the AA pattern (Bailey et al. 2009). "Slot (i, node)" is the place from which a step takes the population
/// that comes in along direction i, and to which it writes the one that goes out along the opposite of i:
///   local:     slot (i, x) = f[i](x): the step before has brought every population to its node
///   streaming: slot (i, x) = f[opposite i](x - c_i): fetched from the neighbour, brought to the other
///   neighbour
/// A link through a wall keeps the node's own place, f[i](x), in both: that is half-way bounce-back at rest.
enum class Turn { local, streaming };

/// How the 19 planes of a lattice lie in memory, in numbers.
struct LatticeLayout {
  std::int64_t lead;          ///< before the first node of a row
  std::int64_t row_stride;    ///< from row to row along y
  std::int64_t rows_a_layer;  ///< along z from layer to layer
  std::int64_t plane_stride;  ///< from direction to direction

  std::int64_t n_numbers() const { return plane_stride * d3q19::n_directions; }
};
LatticeLayout layout_of(const PartBorder& border, int bytes_of_number);

/// One array of 19 planes; each plane holds rows along x, padded to whole cache lines (what the padding holds
/// is of no meaning). Along an axis that is cut there is a halo, one node more at each end: x, y, z of -1 or
/// n (PopulationHalo). Nodes are counted from the first of the part. @tparam Real double or float
template <typename Real>
class PopulationLattice {
 public:
  /// @param box all of it, of which the lattice holds `part`
  PopulationLattice(const GridShape& box, const std::optional<WallPair>& walls, const GridPart& part);

  /// Of the part, without the halo.
  const GridShape& shape() const { return shape_; }

  /// Where the part ends.
  const PartBorder& border() const { return border_; }

  /// Start of the row (y, z) of plane i.
  Real* row(int direction, int y, int z) const {
    return first_row_ + direction * plane_stride_ + (std::int64_t{z} * rows_a_layer_ + y) * row_stride_;
  }

  bool is_cut(int axis) const { return border_.is_cut(axis); }

  /// Address of slot (i, x) for x = 0 .. nx-1 of row (y, z), as if the row went on at both ends: right for
  /// every x at which x - c_i does not leave the row; elsewhere use slot().
  Real* row_slot(Turn turn, int direction, int y, int z) const;

  /// Address of slot (i, x, y, z) for any node.
  Real* slot(Turn turn, int direction, int x, int y, int z) const;

  /// The 19 populations that went out of a node in the last step, which was of this kind: population i lies
  /// where that step wrote it, in the slot of its opposite.
  void get_outgoing(Turn last, int x, int y, int z, Real* populations) const;
  void put_outgoing(Turn last, int x, int y, int z, const Real* populations);

  /// Direction i at this node comes in through a wall.
  bool from_wall(int direction, int x, int y, int z) const;

  /// What a moving wall adds to the population that comes back along direction i, the wall-momentum term of
  /// half-way bounce-back (Ladd 1994): 2 w_i rho c_i.u_wall/cs2 with the reference density (for a velocity in
  /// the wall's plane this keeps mass to the last digit). 0 without a wall there.
  Real wall_gain(int direction) const { return wall_gain_[direction]; }

  const std::optional<WallPair>& walls() const { return walls_; }

 private:
  static constexpr std::align_val_t huge_page{std::size_t{2} << 20};
  struct Release {
    void operator()(Real* memory) const { ::operator delete[](memory, huge_page); }
  };

  void allocate();
  void set_wall_gains();
  /// Where the nodes at `position` along y or z lie in memory.
  int in_memory(int position, int axis) const;

  std::optional<WallPair> walls_;
  GridShape shape_;
  PartBorder border_;
  std::int64_t rows_a_layer_ = 0, row_stride_ = 0, plane_stride_ = 0;
  std::unique_ptr<Real[], Release> planes_;
  Real* first_row_ = nullptr;  ///< of plane 0
  std::array<Real, d3q19::n_directions> wall_gain_{};
};

}  // namespace tanktread::fluid
