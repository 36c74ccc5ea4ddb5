// The runs of grid nodes inside all surfaces, plane by plane, and what changes between two such lists.
// Internal to the coupler.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "coupler/inside.hpp"
#include "coupler/surface_rows.hpp"

namespace tanktread::coupler {

/// Runs sorted by their plane, and in each plane, after sort(), by their first node.
class InsideRuns {
 public:
  explicit InsideRuns(int n_planes) : plane_begin_(n_planes + 1) {}

  /// Takes in the runs of all scans, not sorted within the planes.
  void take_in(std::span<const RowScan> scans);
  /// Sorts the runs of one plane.
  /// @return the first run that begins in that before it; null: there is none
  const InsideRun* sort(int plane);
  /// Cuts the runs of one plane where the part ends; they are linear indices in the part then.
  void cut(int plane, const Grid& grid, const GridPart& part);

  std::span<const InsideRun> all() const { return runs_; }
  std::span<const InsideRun> of_plane(int plane) const {
    return std::span(runs_).subspan(plane_begin_[plane], plane_begin_[plane + 1] - plane_begin_[plane]);
  }
  /// The planes of a share of the work, about as many runs to each.
  AxisRange planes_of(int share, int n_shares) const;

 private:
  std::vector<InsideRun> runs_;
  std::vector<std::size_t> plane_begin_;  ///< of each plane; at the end, the number of runs
};

/// Adds the changes of marks from the runs `before` to the runs `now`, both ascending and without overlap.
void add_changes(std::span<const InsideRun> before, std::span<const InsideRun> now,
                 std::vector<InsideMarks::Change>& changes);

}  // namespace tanktread::coupler
