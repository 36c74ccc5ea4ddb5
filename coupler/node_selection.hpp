// The membrane nodes that have stencils in a part of a grid, and those that are at home there. Internal to
// the coupler.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "coupler/axis_stencil.hpp"
#include "coupler/coupler.hpp"

namespace tanktread::coupler {

/// Numbers `begin` to `end` - 1 of membrane nodes: a share of the work on them.
struct NodeRange {
  NodeRange(std::size_t n_nodes, int share, int n_shares)
      : begin(n_nodes * share / n_shares), end(n_nodes * (share + 1) / n_shares) {}
  std::size_t begin, end;
};

/// The membrane nodes that have stencils, surface by surface and ascending: stencil m, counted through all
/// surfaces, is that of node m unless some have none.
struct NodeSelection {
  bool all = true;                               ///< each node has a stencil, and is at home
  std::vector<std::size_t> n_nodes_of_surface;   ///< with and without stencils
  std::vector<std::size_t> first_stencil = {0};  ///< stencils before each surface; at the end, of all
  std::vector<std::int32_t> numbers;  ///< [m] the node's number in its surface; not used if all have stencils

  /// Numbers in their surfaces of the nodes at home, surface by surface; if all are, 0, 1 ... for the
  /// longest.
  std::vector<std::int32_t> home_numbers;
  std::vector<std::size_t> home_stencils;     ///< of these nodes, unless all are at home
  std::vector<std::size_t> first_home = {0};  ///< nodes at home before each surface, likewise

  std::size_t n_stencils() const { return first_stencil.back(); }
  std::size_t n_home() const { return all ? n_stencils() : home_stencils.size(); }
  /// The stencil of the k-th node at home.
  std::size_t home_stencil(std::size_t k) const { return all ? k : home_stencils[k]; }
  /// The positions of the nodes of stencils begin .. end - 1 of one surface, 3 numbers each.
  /// @param of_surface those of all its nodes @param node that of stencil `begin`
  /// @param memory for 3 (end - begin) numbers, used where they do not lie one after the other
  const double* positions_of(const double* of_surface, std::size_t node, std::size_t begin, std::size_t end,
                             double* memory) const {
    if (all) return of_surface + 3 * node;
    for (std::size_t m = begin; m < end; ++m)
      std::copy_n(of_surface + 3 * std::int64_t{numbers[m]}, 3, memory + 3 * (m - begin));
    return memory;
  }
  std::span<const std::int32_t> home_nodes(std::size_t surface) const {
    return all ? std::span(home_numbers).first(n_nodes_of_surface[surface])
               : std::span(home_numbers)
                     .subspan(first_home[surface], first_home[surface + 1] - first_home[surface]);
  }
};

/// Which surface a membrane node is of, and its number there, for nodes asked for in ascending order.
class SurfaceOfNode {
 public:
  /// @param first_node nodes before each surface; at the end, of all
  explicit SurfaceOfNode(const std::vector<std::size_t>& first_node) : first_node_(first_node) {}
  /// Nodes are asked for by their stencils.
  explicit SurfaceOfNode(const NodeSelection& nodes)
      : first_node_(nodes.first_stencil), numbers_(nodes.all ? nullptr : nodes.numbers.data()) {}

  std::size_t of(std::size_t m) {
    while (m >= first_node_[surface_ + 1]) ++surface_;
    return surface_;
  }
  /// Of the last node that of() was asked for, or another of its surface.
  std::size_t node(std::size_t m) const {
    return numbers_ != nullptr ? static_cast<std::size_t>(numbers_[m]) : m - first_node_[surface_];
  }

 private:
  const std::vector<std::size_t>& first_node_;
  const std::int32_t* numbers_ = nullptr;
  std::size_t surface_ = 0;
};

/// A part of a grid as seen along one axis.
class AxisPart {
 public:
  AxisPart(const Grid& grid, const GridPart& part, int axis, const Kernel& kernel)
      : nodes_(grid.nodes[axis]),
        periodic_(grid.periodic[axis]),
        begin_(part.begin[axis]),
        part_nodes_(part.nodes[axis]),
        width_(width_of(kernel)),
        half_width_(kernel.half_width) {}

  /// Whether the stencil of a node at this coordinate touches the part. A coordinate that has no stencil is
  /// taken for that nearest by; one that is no place, for touching every part: one of them shall refuse it.
  bool is_touched_from(double position) const {
    if (!is_place(position)) return true;
    const auto lowest = static_cast<std::int64_t>(lowest_node(position, half_width_));
    return is_within(lowest, nodes_ - width_, begin_ - (width_ - 1), part_nodes_ + (width_ - 1));
  }

  /// Whether the cell around this coordinate is of the part.
  bool has_cell_of(double position) const {
    return is_place(position) &&
           is_within(static_cast<std::int64_t>(std::floor(position)), nodes_ - 1, begin_, part_nodes_);
  }

 private:
  static bool is_place(double position) { return std::abs(position) <= farthest_coordinate; }

  /// Whether a number, wrapped or held between the walls, is one of `count` from `begin` on.
  bool is_within(std::int64_t number, int last, int begin, int count) const {
    if (periodic_) return wrapped(number - begin, nodes_) < count;
    const std::int64_t from_begin = std::clamp<std::int64_t>(number, 0, last) - begin;
    return from_begin >= 0 && from_begin < count;
  }

  int nodes_;
  bool periodic_;
  int begin_, part_nodes_;
  int width_;
  double half_width_;
};

/// Selects the membrane nodes for one part of a grid.
class NodeSelector {
 public:
  /// @param n_shares the work is cut into this many shares, each done by one thread
  NodeSelector(const Grid& grid, const GridPart& part, const Kernel& kernel, int n_shares);

  /// Fills `nodes` anew; its memory is used again.
  /// @param surfaces 3 numbers a node
  void select(std::span<const std::span<const double>> surfaces, NodeSelection& nodes);

 private:
  /// What a share of the nodes finds.
  struct Found {
    std::vector<std::int32_t> numbers;  ///< of nodes with stencils
    std::vector<std::uint8_t> is_home;  ///< of these
    std::vector<std::size_t> of_surface;
  };

  void find(const std::vector<std::size_t>& first_node, std::span<const std::span<const double>> surfaces,
            NodeRange range, Found& found) const;
  bool is_touched_from(const double* position) const;
  bool has_cell_of(const double* position) const;

  struct CutAxis {
    int axis;
    AxisPart part;
  };
  int n_shares_;
  std::vector<CutAxis> cut_axes_;
  std::vector<Found> found_;
};

}  // namespace tanktread::coupler
