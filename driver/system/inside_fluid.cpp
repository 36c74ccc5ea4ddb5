#include "driver/system/inside_fluid.hpp"

#include "driver/system/components.hpp"
#include "driver/system/node_spans.hpp"

namespace tanktread::driver {

std::unique_ptr<coupler::InsideMarks> make_inside(const Case& the_case) {
  if (!has_contrast(the_case)) return nullptr;
  return std::make_unique<coupler::InsideMarks>(coupler_grid(the_case), the_case.run.threads);
}

GridMarks mark_inside(coupler::InsideMarks& marks, const NodeVectors& positions,
                      const std::vector<Eigen::Matrix3Xi>& triangles, bool anew) {
  const auto corners = corners_of(triangles);
  if (anew) {
    marks.mark(views(positions), corners);
  } else {
    marks.update(views(positions), corners);
  }
  std::vector<std::int64_t> nodes;
  GridMarks news;
  for (const auto& change : marks.changes()) {
    nodes.push_back(change.node);
    news.capsule.push_back(change.now);
  }
  news.nodes = std::make_shared<const std::vector<std::int64_t>>(std::move(nodes));
  return news;
}

}  // namespace tanktread::driver
