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

/// A part of a step: work(membrane, begin, end) for things of each membrane.
template <class Work>
struct Part {
  const Counted& things;
  Work work;
};

// Said for compilers that do not deduce it for aggregates.
template <class Work>
Part(const Counted&, Work) -> Part<Work>;

/// The threads at work on several membranes, part after part of a step.
class Team {
 public:
  Team(const Counted& blocks, int n_threads) : n_membranes_(blocks.n_membranes()), n_threads_(n_threads) {
    // With many membranes each thread takes whole ones, which stay in its cache from part to part. Else none
    // would be idle for more than an eighth of the time.
    Eigen::Index largest = 0;
    for (std::size_t k = 0; k < n_membranes_; ++k) largest = std::max(largest, blocks.of(k));
    takes_whole_ = 8 * n_threads * largest <= blocks.total();
  }

  template <class... Works>
  void work(const Part<Works>&... parts) const {
    if (!takes_whole_) return (parts.things.share_out(n_threads_, parts.work), ...);
#pragma omp parallel for num_threads(n_threads_) schedule(dynamic, 1)
    for (std::size_t k = 0; k < n_membranes_; ++k) (parts.work(k, 0, parts.things.of(k)), ...);
  }

 private:
  std::size_t n_membranes_;
  int n_threads_;
  bool takes_whole_;
};

}  // namespace

void advance(std::span<const MembraneStep> steps) {
  if (steps.empty()) return;
  std::vector<Membrane::Implementation*> membranes;
  const auto has_terms = [](const MembraneStep& step) {
    return step.force && step.membrane->implementation_->terms != nullptr;
  };
  // What has no history and depends on no other element.
  const auto is_at_once = [&](const MembraneStep& step) {
    return !step.force || (!step.membrane->implementation_->viscous && !has_terms(step));
  };
  Counted blocks, nodes, edge_blocks, whole;
  for (const auto& step : steps) {
    auto& self = *membranes.emplace_back(step.membrane->implementation_.get());
    if (step.positions) self.require_column_per_node("the position array", step.positions->cols());
    if (step.force) self.require_column_per_node("the force array", step.force->cols());
    blocks.add(self.n_blocks());
    nodes.add(self.positions.cols());
    edge_blocks.add(has_terms(step) ? self.terms->n_edge_blocks() : 0);
    whole.add(1);
  }
  const Team team(blocks, membranes.front()->n_threads);

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
      if (has_terms(steps[k])) self.measure_for_terms(block);
      // A law is never asked about an element that is turned over.
      if (is_sound && steps[k].force && is_at_once(steps[k]))
        self.elastic_corner_forces(block, self.corner_force);
    }
  };
  const auto gather = [&](bool at_once) {
    return [&, at_once](std::size_t k, Eigen::Index begin, Eigen::Index end) {
      auto& self = *membranes[k];
      if (!steps[k].force || is_at_once(steps[k]) != at_once) return;
      for (Eigen::Index node = begin; node < end; ++node) {
        Eigen::Vector3d force = self.corners_of_node.sum(self.corner_force, node);
        if (self.terms) force += self.terms->node_force(node);
        steps[k].force->col(node) = force;
      }
    };
  };

  team.work(Part{nodes, take_positions}, Part{blocks, check}, Part{nodes, gather(true)});
  const auto bad = std::ranges::find(is_bad, 1) - is_bad.begin();
  if (bad != std::ssize(is_bad)) {
    const std::size_t k = blocks.membrane_of(bad);
    try {
      membranes[k]->report_block(bad - blocks.before(k));
    } catch (const InvertedElement& error) {
      throw InvertedElement(error.what(), k);
    }
  }
  for (std::size_t k = 0; k < steps.size(); ++k) {
    membranes[k]->check.accept();
    if (steps[k].force && membranes[k]->viscous) membranes[k]->viscous->begin_step();
  }
  if (std::ranges::all_of(steps, is_at_once)) return;

  const auto measure_edges = [&](std::size_t k, Eigen::Index begin, Eigen::Index end) {
    auto& self = *membranes[k];
    for (auto block = static_cast<int>(begin); block < end; ++block) self.terms->measure_edges(block);
  };
  const auto measure_nodes = [&](std::size_t k, Eigen::Index begin, Eigen::Index end) {
    if (has_terms(steps[k]))
      membranes[k]->terms->measure_nodes(static_cast<int>(begin), static_cast<int>(end));
  };
  const auto derive = [&](std::size_t k, Eigen::Index begin, Eigen::Index end) {
    if (begin < end && has_terms(steps[k])) membranes[k]->terms->derive();
  };
  const auto force_corners = [&](std::size_t k, Eigen::Index begin, Eigen::Index end) {
    auto& self = *membranes[k];
    if (is_at_once(steps[k])) return;
    for (Eigen::Index block = begin; block < end; ++block) {
      if (self.viscous) {
        self.next_corner_forces(block);
      } else {
        self.elastic_corner_forces(block, self.corner_force);
      }
      if (self.terms) self.find_term_forces(block);
    }
  };
  team.work(Part{edge_blocks, measure_edges}, Part{nodes, measure_nodes}, Part{whole, derive},
            Part{blocks, force_corners}, Part{nodes, gather(false)});
}

}  // namespace tanktread::membrane
