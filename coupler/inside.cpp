#include "coupler/inside.hpp"

#include <algorithm>
#include <exception>
#include <string>
#include <utility>
#include <vector>

#include "coupler/grid_region.hpp"
#include "coupler/inside_runs.hpp"
#include "coupler/surface_rows.hpp"
#include "coupler/threads.hpp"

namespace tanktread::coupler {

struct InsideMarks::Implementation {
  using Positions = std::span<const std::span<const double>>;
  using Triangles = std::span<const std::span<const int>>;

  Implementation(const Grid& the_grid, const GridPart& the_part, int threads)
      : grid(the_grid),
        part(the_part),
        n_threads(threads),
        runs(part.nodes[2]),
        new_runs(part.nodes[2]),
        changed(threads) {
    std::int64_t n_nodes = 1;
    for (const int nodes : part.nodes) n_nodes *= nodes;
    marks.resize(n_nodes);
  }

  void find_runs(Positions positions, Triangles triangles);
  void take_in(Positions positions, Triangles triangles);
  void scan();
  void compare();
  void keep();

  Grid grid;
  GridPart part;
  int n_threads;
  std::vector<RowSurface> surfaces;
  std::vector<RowBlock> blocks;
  std::vector<RowScan> scans;                ///< of these
  InsideRuns runs, new_runs;                 ///< those of the marks, and those to come
  std::vector<std::vector<Change>> changed;  ///< by each share of the planes
  std::vector<Change> changes;
  std::vector<std::int32_t> marks;
};

namespace {

/// @return the part, if all axes have nodes and it is within them @throws std::invalid_argument
const GridPart& checked(const Grid& grid, const GridPart& part) {
  for (int axis = 0; axis < 3; ++axis) {
    if (grid.nodes[axis] > 0) continue;
    throw std::invalid_argument("coupler: grid of " + std::to_string(grid.nodes[axis]) + " nodes along " +
                                "xyz"[axis] + "; 1 or more is needed");
  }
  require_part(grid, part);
  return part;
}

/// @param run begins in the run that is before it in its list
[[noreturn]] void refuse_overlap(const Grid& grid, const InsideRun* run) {
  const std::int64_t nx = grid.nodes[0], ny = grid.nodes[1], node = run->begin;
  const auto [surface, other] = std::minmax({run[-1].mark - 1, run->mark - 1});
  throw InsideError("coupler: surface " + std::to_string(surface) +
                        (surface == other ? " overlaps its periodic image"
                                          : " and surface " + std::to_string(other) + " overlap") +
                        " at grid node (" + std::to_string(node % nx) + ", " +
                        std::to_string(node / nx % ny) + ", " + std::to_string(node / (nx * ny)) + ")",
                    precedence_of(InsideFault::overlap, static_cast<std::uint64_t>(node)));
}

}  // namespace

// The runs of the surfaces, and how they differ from those of the marks.
void InsideMarks::Implementation::find_runs(Positions positions, Triangles triangles) {
  if (triangles.size() != positions.size()) {
    throw std::invalid_argument("coupler: positions and triangles are of " +
                                std::to_string(positions.size()) + " and " +
                                std::to_string(triangles.size()) + " surfaces");
  }
  take_in(positions, triangles);
  scan();
  new_runs.take_in(scans);
  compare();
}

void InsideMarks::Implementation::take_in(Positions positions, Triangles triangles) {
  const int n_surfaces = static_cast<int>(positions.size());
  surfaces.resize(n_surfaces);
  std::vector<std::exception_ptr> thrown(n_surfaces);
#pragma omp parallel for num_threads(n_threads) schedule(dynamic)
  for (int s = 0; s < n_surfaces; ++s) {
    try {
      surfaces[s].take_in(grid, s, positions[s], triangles[s]);
    } catch (...) {
      thrown[s] = std::current_exception();
    }
  }
  for (const auto& exception : thrown) {
    if (exception) std::rethrow_exception(exception);
  }
}

// Each scan goes through all triangles of a surface, which costs little where they do not meet its planes:
// there are no more scans than the threads need.
void InsideMarks::Implementation::scan() {
  blocks.clear();
  for (const RowSurface& surface : surfaces) add_blocks(grid, part, surface, blocks);
  const int n_blocks = static_cast<int>(blocks.size());
  if (n_blocks == 0) return scans.clear();
  const int cuts = n_threads == 1 ? 1 : (2 * n_threads + n_blocks - 1) / n_blocks;
  scans.resize(std::size_t{1} * n_blocks * cuts);
#pragma omp parallel for num_threads(n_threads) schedule(dynamic)
  for (int number = 0; number < n_blocks * cuts; ++number) {
    RowBlock block = blocks[number / cuts];
    const int piece = number % cuts, first = block.planes.begin, n_planes = block.planes.end - first;
    block.planes = {first + n_planes * piece / cuts, first + n_planes * (piece + 1) / cuts};
    scans[number].find(grid, part, block);
  }
  const InsideError* fault = nullptr;
  for (const RowScan& scan : scans) {
    if (scan.fault() && (fault == nullptr || scan.fault()->precedence < fault->precedence))
      fault = &*scan.fault();
  }
  if (fault != nullptr) throw InsideError(*fault);
}

// Sorts the new runs, and lists what they change.
void InsideMarks::Implementation::compare() {
  std::vector<const InsideRun*> overlaps(n_threads, nullptr);
#pragma omp parallel for num_threads(n_threads) schedule(static, 1)
  for (int share = 0; share < n_threads; ++share) {
    changed[share].clear();
    const AxisRange planes = new_runs.planes_of(share, n_threads);
    for (int plane = planes.begin; plane < planes.end; ++plane) {
      overlaps[share] = new_runs.sort(plane);
      if (overlaps[share] != nullptr) break;
      if (!is_whole(grid, part)) new_runs.cut(plane, grid, part);
      add_changes(runs.of_plane(plane), new_runs.of_plane(plane), changed[share]);
    }
  }
  for (const InsideRun* overlap : overlaps) {
    if (overlap != nullptr) refuse_overlap(grid, overlap);
  }
}

// From now on the new runs are those of the marks.
void InsideMarks::Implementation::keep() {
  changes.clear();
  for (const auto& of_share : changed) changes.insert(changes.end(), of_share.begin(), of_share.end());
  std::swap(runs, new_runs);
}

InsideMarks::InsideMarks(const Grid& grid, int threads) : InsideMarks(grid, whole_of(grid), threads) {}

InsideMarks::InsideMarks(const Grid& grid, const GridPart& part, int threads)
    : implementation_(
          std::make_unique<Implementation>(grid, checked(grid, part), number_of_threads(threads))) {}

InsideMarks::~InsideMarks() = default;

void InsideMarks::mark(std::span<const std::span<const double>> positions,
                       std::span<const std::span<const int>> triangles) {
  implementation_->find_runs(positions, triangles);
  implementation_->keep();
  auto& marks = implementation_->marks;
  std::ranges::fill(marks, 0);
  for (const InsideRun& run : implementation_->runs.all())
    std::fill(marks.begin() + run.begin, marks.begin() + run.end, run.mark);
}

void InsideMarks::update(std::span<const std::span<const double>> positions,
                         std::span<const std::span<const int>> triangles) {
  implementation_->find_runs(positions, triangles);
  implementation_->keep();
  for (const Change& change : implementation_->changes) implementation_->marks[change.node] = change.now;
}

std::span<const std::int32_t> InsideMarks::marks() const {
  return implementation_->marks;
}

std::span<const InsideMarks::Change> InsideMarks::changes() const {
  return implementation_->changes;
}

}  // namespace tanktread::coupler
