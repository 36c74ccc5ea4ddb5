#include "coupler/inside_runs.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>

namespace tanktread::coupler {
namespace {

/// The marks of runs, asked for at ascending nodes.
class Walk {
 public:
  explicit Walk(std::span<const InsideRun> runs) : runs_(runs) {}

  /// Goes on to a node.
  void go_to(std::int64_t node) {
    while (!runs_.empty() && runs_.front().end <= node) runs_ = runs_.subspan(1);
    mark_ = !runs_.empty() && runs_.front().begin <= node ? runs_.front().mark : 0;
  }
  /// Of the node gone to.
  std::int32_t mark() const { return mark_; }
  /// The next node that may have another mark.
  std::int64_t next() const {
    if (runs_.empty()) return std::numeric_limits<std::int64_t>::max();
    return mark_ != 0 ? runs_.front().end : runs_.front().begin;
  }

 private:
  std::span<const InsideRun> runs_;
  std::int32_t mark_ = 0;
};

}  // namespace

void InsideRuns::take_in(std::span<const RowScan> scans) {
  std::ranges::fill(plane_begin_, 0);
  std::size_t n_runs = 0;
  for (const RowScan& scan : scans) {
    n_runs += scan.runs().size();
    for (const InsideRun& run : scan.runs()) ++plane_begin_[run.plane + 1];
  }
  for (std::size_t plane = 1; plane < plane_begin_.size(); ++plane)
    plane_begin_[plane] += plane_begin_[plane - 1];
  runs_.resize(n_runs);
  for (const RowScan& scan : scans) {
    for (const InsideRun& run : scan.runs()) runs_[plane_begin_[run.plane]++] = run;
  }
  // Each now stands where the next plane begins.
  std::shift_right(plane_begin_.begin(), plane_begin_.end(), 1);
  plane_begin_.front() = 0;
}

const InsideRun* InsideRuns::sort(int plane) {
  const auto begin = runs_.begin() + plane_begin_[plane], end = runs_.begin() + plane_begin_[plane + 1];
  std::sort(begin, end, [](const InsideRun& a, const InsideRun& b) {
    return a.begin != b.begin ? a.begin < b.begin : a.mark < b.mark;
  });
  const auto before = std::adjacent_find(
      begin, end, [](const InsideRun& first, const InsideRun& second) { return second.begin < first.end; });
  return before == end ? nullptr : &*before + 1;
}

void InsideRuns::cut(int plane, const Grid& grid, const GridPart& part) {
  for (std::size_t k = plane_begin_[plane]; k < plane_begin_[plane + 1]; ++k) {
    InsideRun& run = runs_[k];
    const std::int64_t row = run.begin / grid.nodes[0], y = row % grid.nodes[1] - part.begin[1];
    const std::int64_t first = row * grid.nodes[0] + part.begin[0], last = first + part.nodes[0],
                       moved = (std::int64_t{plane} * part.nodes[1] + y) * part.nodes[0] - first;
    run.begin = std::max(run.begin, first) + moved;
    run.end = std::min(run.end, last) + moved;
  }
}

AxisRange InsideRuns::planes_of(int share, int n_shares) const {
  const auto first_plane = [&](int number) {
    const std::size_t runs_before = runs_.size() * number / n_shares;
    const auto plane = std::ranges::lower_bound(plane_begin_, runs_before) - plane_begin_.begin();
    return std::min(static_cast<int>(plane), static_cast<int>(plane_begin_.size()) - 1);
  };
  return {share == 0 ? 0 : first_plane(share),
          share + 1 == n_shares ? static_cast<int>(plane_begin_.size()) - 1 : first_plane(share + 1)};
}

void add_changes(std::span<const InsideRun> before, std::span<const InsideRun> now,
                 std::vector<InsideMarks::Change>& changes) {
  Walk old_runs(before), new_runs(now);
  for (std::int64_t node = 0, end;; node = end) {
    old_runs.go_to(node);
    new_runs.go_to(node);
    end = std::min(old_runs.next(), new_runs.next());
    if (end == std::numeric_limits<std::int64_t>::max()) return;
    if (old_runs.mark() == new_runs.mark()) continue;
    for (; node < end; ++node) changes.push_back({node, old_runs.mark(), new_runs.mark()});
  }
}

}  // namespace tanktread::coupler
