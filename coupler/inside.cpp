#include "coupler/inside.hpp"

#include <algorithm>
#include <exception>
#include <string>
#include <utility>
#include <vector>

#include "coupler/inside_runs.hpp"
#include "coupler/surface_rows.hpp"
#include "coupler/threads.hpp"

namespace tanktread::coupler {

struct InsideMarks::Implementation {
  using Positions = std::span<const std::span<const double>>;
  using Triangles = std::span<const std::span<const int>>;

  Implementation(const Grid& the_grid, int threads)
      : grid(the_grid), n_threads(threads), runs(grid.nodes[2]), new_runs(grid.nodes[2]), changed(threads) {
    std::int64_t n_nodes = 1;
    for (const int nodes : grid.nodes) n_nodes *= nodes;
    marks.resize(n_nodes);
  }

  void find_runs(Positions positions, Triangles triangles);
  void take_in(Positions positions, Triangles triangles);
  void scan();
  void compare();
  void keep();

  Grid grid;
  int n_threads;
  std::vector<RowSurface> surfaces;
  std::vector<RowScan> scans;
  InsideRuns runs, new_runs;                 ///< those of the marks, and those to come
  std::vector<std::vector<Change>> changed;  ///< by each share of the planes
  std::vector<Change> changes;
  std::vector<std::int32_t> marks;
};

namespace {

/// @return the grid, if all its axes have nodes @throws std::invalid_argument
const Grid& checked(const Grid& grid) {
  for (int axis = 0; axis < 3; ++axis) {
    if (grid.nodes[axis] > 0) continue;
    throw std::invalid_argument("coupler: grid of " + std::to_string(grid.nodes[axis]) + " nodes along " +
                                "xyz"[axis] + "; 1 or more is needed");
  }
  return grid;
}

/// @param run begins in the run that is before it in its list
[[noreturn]] void refuse_overlap(const Grid& grid, const InsideRun* run) {
  const std::int64_t nx = grid.nodes[0], ny = grid.nodes[1], node = run->begin;
  const auto [surface, other] = std::minmax({run[-1].mark - 1, run->mark - 1});
  throw InsideError("coupler: surface " + std::to_string(surface) +
                    (surface == other ? " overlaps its periodic image"
                                      : " and surface " + std::to_string(other) + " overlap") +
                    " at grid node (" + std::to_string(node % nx) + ", " + std::to_string(node / nx % ny) +
                    ", " + std::to_string(node / (nx * ny)) + ")");
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
  const int n_surfaces = static_cast<int>(surfaces.size());
  if (n_surfaces == 0) return scans.clear();
  const int parts = n_threads == 1 ? 1 : (2 * n_threads + n_surfaces - 1) / n_surfaces;
  scans.resize(std::size_t{1} * n_surfaces * parts);
#pragma omp parallel for num_threads(n_threads) schedule(dynamic)
  for (int number = 0; number < n_surfaces * parts; ++number) {
    const RowSurface& surface = surfaces[number / parts];
    const int part = number % parts, first = surface.planes.begin, n_planes = surface.planes.end - first;
    scans[number].find(grid, surface,
                       {first + n_planes * part / parts, first + n_planes * (part + 1) / parts});
  }
  for (const RowScan& scan : scans) {
    if (!scan.fault().empty()) throw InsideError(scan.fault());
  }
}

// Sorts the new runs, and lists what they change.
void InsideMarks::Implementation::compare() {
  std::vector<const InsideRun*> overlaps(n_threads, nullptr);
#pragma omp parallel for num_threads(n_threads) schedule(static, 1)
  for (int share = 0; share < n_threads; ++share) {
    changed[share].clear();
    const AxisRange planes = new_runs.planes_of(share, n_threads);
    for (int plane = planes.begin; plane < planes.end && !overlaps[share]; ++plane) {
      overlaps[share] = new_runs.sort(plane);
      add_changes(runs.of_plane(plane), new_runs.of_plane(plane), changed[share]);
    }
  }
  for (const InsideRun* overlap : overlaps) {
    if (overlap) refuse_overlap(grid, overlap);
  }
}

// From now on the new runs are those of the marks.
void InsideMarks::Implementation::keep() {
  changes.clear();
  for (const auto& of_share : changed) changes.insert(changes.end(), of_share.begin(), of_share.end());
  std::swap(runs, new_runs);
}

InsideMarks::InsideMarks(const Grid& grid, int threads)
    : implementation_(std::make_unique<Implementation>(checked(grid), number_of_threads(threads))) {}

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
