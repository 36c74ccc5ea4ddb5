#include "membrane/membrane_step.hpp"

#include <algorithm>
#include <vector>

#include "membrane/implementation.hpp"

namespace tanktread::membrane {
namespace {

/// Things of several membranes, counted one after the other.
class Counted {
 public:
  void add(Eigen::Index n_things) { first_.push_back(first_.back() + n_things); }
  std::size_t n_membranes() const { return first_.size() - 1; }
  Eigen::Index of(std::size_t membrane) const { return first_[membrane + 1] - first_[membrane]; }
  Eigen::Index before(std::size_t membrane) const { return first_[membrane]; }
  Eigen::Index total() const { return first_.back(); }

  /// The membrane of a thing.
  std::size_t membrane_of(Eigen::Index thing) const {
    return std::ranges::upper_bound(first_, thing) - first_.begin() - 1;
  }

  /// Calls work(membrane, begin, end) for the things of each membrane, cut so that each of the threads has as
  /// many as the others.
  template <class Work>
  void share_out(int n_threads, const Work& work) const {
#pragma omp parallel for num_threads(n_threads) schedule(static, 1)
    for (int share = 0; share < n_threads; ++share) {
      Eigen::Index begin = first_.back() * share / n_threads;
      const Eigen::Index end = first_.back() * (share + 1) / n_threads;
      for (std::size_t k = membrane_of(begin); begin < end; ++k) {
        const Eigen::Index last = std::min(end, first_[k + 1]);
        work(k, begin - first_[k], last - first_[k]);
        begin = last;
      }
    }
  }

 private:
  std::vector<Eigen::Index> first_ = {0};
};

/// A part of a step: work(membrane, begin, end) for blocks of elements, or for nodes.
template <class Work>
struct OnBlocks {
  Work work;
};
template <class Work>
struct OnNodes {
  Work work;
};

// Said for compilers that do not deduce them for aggregates.
template <class Work>
OnBlocks(Work) -> OnBlocks<Work>;
template <class Work>
OnNodes(Work) -> OnNodes<Work>;

/// The threads at work on several membranes, part after part of a step.
class Team {
 public:
  Team(const Counted& blocks, const Counted& nodes, int n_threads)
      : blocks_(blocks), nodes_(nodes), n_threads_(n_threads) {
    // With many membranes each thread takes whole ones, which stay in its cache from part to part. Else none
    // would be idle for more than an eighth of the time.
    Eigen::Index largest = 0;
    for (std::size_t k = 0; k < blocks.n_membranes(); ++k) largest = std::max(largest, blocks.of(k));
    takes_whole_ = 8 * n_threads * largest <= blocks.total();
  }

  template <class... Parts>
  void work(const Parts&... parts) const {
    if (!takes_whole_) return (share_out(parts), ...);
#pragma omp parallel for num_threads(n_threads_) schedule(dynamic, 1)
    for (std::size_t k = 0; k < blocks_.n_membranes(); ++k) (whole(k, parts), ...);
  }

 private:
  template <class Work>
  void share_out(const OnBlocks<Work>& part) const {
    blocks_.share_out(n_threads_, part.work);
  }
  template <class Work>
  void share_out(const OnNodes<Work>& part) const {
    nodes_.share_out(n_threads_, part.work);
  }
  template <class Work>
  void whole(std::size_t k, const OnBlocks<Work>& part) const {
    part.work(k, 0, blocks_.of(k));
  }
  template <class Work>
  void whole(std::size_t k, const OnNodes<Work>& part) const {
    part.work(k, 0, nodes_.of(k));
  }

  const Counted &blocks_, &nodes_;
  int n_threads_;
  bool takes_whole_;
};

}  // namespace

void advance(std::span<const MembraneStep> steps) {
  if (steps.empty()) return;
  std::vector<Membrane::Implementation*> membranes;
  Counted blocks, nodes;
  for (const auto& step : steps) {
    auto& self = *membranes.emplace_back(step.membrane->implementation_.get());
    if (step.positions) self.require_column_per_node("the position array", step.positions->cols());
    if (step.force) self.require_column_per_node("the force array", step.force->cols());
    blocks.add(self.n_blocks());
    nodes.add(self.positions.cols());
  }
  const Team team(blocks, nodes, membranes.front()->n_threads);

  const auto take_positions = [&](std::size_t k, Eigen::Index begin, Eigen::Index end) {
    if (!steps[k].positions) return;
    membranes[k]->positions.middleCols(begin, end - begin) =
        steps[k].positions->middleCols(begin, end - begin);
  };
  // What has no history is computed at once, while its corners are at hand: nothing is lost if that was for
  // nothing.
  std::vector<char> is_bad(blocks.total(), 0);
  const auto check = [&](std::size_t k, Eigen::Index begin, Eigen::Index end) {
    auto& self = *membranes[k];
    for (Eigen::Index block = begin; block < end; ++block) {
      const bool is_sound = self.check_block(block);
      is_bad[blocks.before(k) + block] = !is_sound;
      // A law is never asked about an element that is turned over.
      if (is_sound && steps[k].force && !self.viscous) self.elastic_corner_forces(block, self.corner_force);
    }
  };
  const auto take_strain = [&](std::size_t k, Eigen::Index begin, Eigen::Index end) {
    auto& self = *membranes[k];
    if (!steps[k].force || !self.viscous) return;
    for (Eigen::Index block = begin; block < end; ++block) self.next_corner_forces(block);
  };
  const auto gather = [&](bool viscous) {
    return [&, viscous](std::size_t k, Eigen::Index begin, Eigen::Index end) {
      auto& self = *membranes[k];
      if (!steps[k].force || self.viscous.has_value() != viscous) return;
      for (Eigen::Index node = begin; node < end; ++node)
        steps[k].force->col(node) = self.corners_of_node.sum(self.corner_force, node);
    };
  };

  team.work(OnNodes{take_positions}, OnBlocks{check}, OnNodes{gather(false)});
  const auto bad = std::ranges::find(is_bad, 1) - is_bad.begin();
  if (bad != std::ssize(is_bad)) {
    const std::size_t k = blocks.membrane_of(bad);
    membranes[k]->report_block(bad - blocks.before(k));
  }
  bool any_viscous = false;
  for (std::size_t k = 0; k < steps.size(); ++k) {
    membranes[k]->check.accept();
    if (!steps[k].force || !membranes[k]->viscous) continue;
    membranes[k]->viscous->begin_step();
    any_viscous = true;
  }
  if (any_viscous) team.work(OnBlocks{take_strain}, OnNodes{gather(true)});
}

}  // namespace tanktread::membrane
