// Arrays on the nodes of all capsules: their sizes, and loops that threads share.
#pragma once

#include <algorithm>

#include "driver/packets/packets.hpp"

namespace tanktread::driver {

/// As many matrices as `like`, of the same sizes. Their numbers are of no use; memory that fits is kept.
inline void resize_like(const NodeVectors& like, NodeVectors& vectors) {
  vectors.resize(like.size());
  for (std::size_t k = 0; k < like.size(); ++k) vectors[k].resize(3, like[k].cols());
}

/// Calls work(capsule, begin, end) for the nodes `begin` to `end` - 1 of each capsule, cut so that each
/// thread has as many nodes as the others.
template <class Work>
void share_out_nodes(const NodeVectors& like, int threads, const Work& work) {
  Eigen::Index n_nodes = 0;
  for (const auto& matrix : like) n_nodes += matrix.cols();
#pragma omp parallel for num_threads(threads) schedule(static, 1)
  for (int share = 0; share < threads; ++share) {
    const Eigen::Index begin = n_nodes * share / threads, end = n_nodes * (share + 1) / threads;
    Eigen::Index before = 0;  // nodes of the capsules before
    for (std::size_t k = 0; k < like.size() && before < end; ++k) {
      const Eigen::Index last = before + like[k].cols();
      if (last > begin) work(k, std::max(begin, before) - before, std::min(end, last) - before);
      before = last;
    }
  }
}

}  // namespace tanktread::driver
