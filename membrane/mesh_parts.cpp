#include "membrane/mesh_parts.hpp"

#include <algorithm>
#include <array>
#include <numeric>

namespace tanktread::membrane {
namespace {

/// Side k of a triangle t, number 3 t + k, goes from its corner k to the next; corners have the same numbers.
int next_corner(int side) {
  return side % 3 == 2 ? side - 2 : side + 1;
}

/// Things in groups that are joined two by two.
class Groups {
 public:
  explicit Groups(Eigen::Index n) : above_(n) { std::iota(above_.begin(), above_.end(), 0); }

  /// The first thing of its group.
  int first_of(int thing) {
    while (above_[thing] != thing) thing = above_[thing] = above_[above_[thing]];
    return thing;
  }
  void join(int a, int b) {
    const auto [low, high] = std::minmax({first_of(a), first_of(b)});
    above_[high] = low;
  }

 private:
  std::vector<int> above_;
};

/// Calls visit(side, side) for each edge of just two triangles.
template <class Visit>
void visit_edges(const Eigen::Matrix3Xi& triangles, const Visit& visit) {
  std::vector<std::array<int, 3>> sides;  // lower node, higher node, side
  for (int side = 0; side < triangles.size(); ++side) {
    const auto [low, high] = std::minmax({triangles.data()[side], triangles.data()[next_corner(side)]});
    sides.push_back({low, high, side});
  }
  std::ranges::sort(sides);
  for (std::size_t begin = 0, end = 0; begin < sides.size(); begin = end) {
    while (end < sides.size() && sides[end][0] == sides[begin][0] && sides[end][1] == sides[begin][1]) ++end;
    if (end - begin == 2) visit(sides[begin][2], sides[begin + 1][2]);
  }
}

}  // namespace

std::vector<int> parts_of(const Eigen::Matrix3Xi& triangles) {
  Groups groups(triangles.cols());
  visit_edges(triangles, [&](int a, int b) { groups.join(a / 3, b / 3); });
  std::vector<int> part(triangles.cols());
  int n_parts = 0;
  for (int t = 0; t < triangles.cols(); ++t) {
    const int first = groups.first_of(t);
    part[t] = first == t ? n_parts++ : part[first];
  }
  return part;
}

int count_pinched_nodes(const Eigen::Matrix3Xi& triangles) {
  const int* node_of = triangles.data();
  Groups corners(triangles.size());
  visit_edges(triangles, [&](int a, int b) {
    const bool same_way = node_of[a] == node_of[b];
    corners.join(a, same_way ? b : next_corner(b));
    corners.join(next_corner(a), same_way ? next_corner(b) : b);
  });
  std::vector<int> n_fans(triangles.size() == 0 ? 0 : triangles.maxCoeff() + 1, 0);
  for (int corner = 0; corner < triangles.size(); ++corner) {
    if (corners.first_of(corner) == corner) ++n_fans[node_of[corner]];
  }
  return static_cast<int>(std::ranges::count_if(n_fans, [](int n) { return n > 1; }));
}

}  // namespace tanktread::membrane
