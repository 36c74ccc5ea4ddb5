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
  Eigen::Index before(std::size_t membrane) const { return first_[membrane]; }

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
  const int n_threads = membranes.front()->n_threads;

  nodes.share_out(n_threads, [&](std::size_t k, Eigen::Index begin, Eigen::Index end) {
    if (!steps[k].positions) return;
    membranes[k]->positions.middleCols(begin, end - begin) =
        steps[k].positions->middleCols(begin, end - begin);
  });

  // What has no history is computed at once, while its corners are at hand: nothing is lost if that was for
  // nothing.
  std::vector<char> is_bad(blocks.before(steps.size()), 0);
  blocks.share_out(n_threads, [&](std::size_t k, Eigen::Index begin, Eigen::Index end) {
    auto& self = *membranes[k];
    for (Eigen::Index block = begin; block < end; ++block) {
      is_bad[blocks.before(k) + block] = !self.check_block(block);
      if (steps[k].force && !self.viscous) self.elastic_corner_forces(block, self.corner_force);
    }
  });
  const auto bad = std::ranges::find(is_bad, 1) - is_bad.begin();
  if (bad != std::ssize(is_bad)) {
    const std::size_t k = blocks.membrane_of(bad);
    membranes[k]->report_block(bad - blocks.before(k));
  }

  for (std::size_t k = 0; k < steps.size(); ++k) {
    membranes[k]->check.accept();
    if (steps[k].force && membranes[k]->viscous) membranes[k]->viscous->begin_step();
  }
  blocks.share_out(n_threads, [&](std::size_t k, Eigen::Index begin, Eigen::Index end) {
    auto& self = *membranes[k];
    if (!steps[k].force || !self.viscous) return;
    for (Eigen::Index block = begin; block < end; ++block) self.next_corner_forces(block);
  });
  nodes.share_out(n_threads, [&](std::size_t k, Eigen::Index begin, Eigen::Index end) {
    if (!steps[k].force) return;
    for (Eigen::Index node = begin; node < end; ++node)
      steps[k].force->col(node) = membranes[k]->corners_of_node.sum(membranes[k]->corner_force, node);
  });
}

}  // namespace tanktread::membrane
