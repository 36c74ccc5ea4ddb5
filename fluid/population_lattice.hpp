// Where populations lie in memory, and where each finds its neighbour: the in-place (AA) update.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <new>
#include <optional>

#include "fluid/d3q19.hpp"
#include "fluid/fluid.hpp"
#include "fluid/lattice_boltzmann.hpp"

namespace tanktread::fluid {

/// The two kinds of step that follow each other in turn, the even (local) and the odd (streaming) steps of
/// the AA pattern (Bailey et al. 2009). "Slot (i, node)" is the place from which a step takes the population
/// that comes in along direction i, and to which it writes the one that goes out along the opposite of i:
///   local:     slot (i, x) = f[i](x): the step before has brought every population to its node
///   streaming: slot (i, x) = f[opposite i](x - c_i): fetched from the neighbour, brought to the other
///   neighbour
/// A link through a wall keeps the node's own place, f[i](x), in both: that is half-way bounce-back at rest.
enum class Turn { local, streaming };

/// One array of 19 planes; each plane holds rows along x, padded to whole cache lines (what the padding holds
/// is of no meaning). @tparam Real double or float
template <typename Real>
class PopulationLattice {
 public:
  PopulationLattice(const GridShape& shape, const std::optional<WallPair>& walls);

  const GridShape& shape() const { return shape_; }

  /// Start of the row (y, z) of plane i.
  Real* row(int direction, int y, int z) const {
    return planes_.get() + direction * plane_stride_ + (std::int64_t{z} * shape_.ny + y) * row_stride_;
  }

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
  GridShape shape_;
  std::optional<WallPair> walls_;
  std::int64_t row_stride_ = 0, plane_stride_ = 0;
  std::unique_ptr<Real[], Release> planes_;
  std::array<Real, d3q19::n_directions> wall_gain_{};
};

}  // namespace tanktread::fluid
