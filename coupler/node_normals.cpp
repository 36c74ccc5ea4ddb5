#include "coupler/node_normals.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>

#include "coupler/node_selection.hpp"
#include "coupler/products.hpp"
#include "coupler/surface_check.hpp"
#include "coupler/threads.hpp"

namespace tanktread::coupler {
namespace {

/// Adds to the normal at the node `at` that of its triangle with the next two.
void add_normal(const double* positions, int at, int next, int last, double* normal) {
  const double *a = &positions[3 * at], *b = &positions[3 * next], *c = &positions[3 * last];
  const double u[] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]}, v[] = {c[0] - a[0], c[1] - a[1], c[2] - a[2]};
  const double weight = 1 / (dot(u, u) * dot(v, v));
  for (int axis = 0; axis < 3; ++axis) {
    const int i = (axis + 1) % 3, j = (axis + 2) % 3;
    normal[axis] = multiply_add(weight, multiply_add(u[i], v[j], -(u[j] * v[i])), normal[axis]);
  }
}

}  // namespace

void node_normals(std::span<const double> positions, std::span<const int> triangles,
                  std::span<double> normals) {
  require_surface(positions.size(), triangles, "normals", normals.size());
  NodeNormals finder(1);
  std::ranges::copy(finder.find({&positions, 1}, {&triangles, 1}).front(), normals.begin());
}

NodeNormals::NodeNormals(int threads) : n_threads_(number_of_threads(threads)) {}

bool NodeNormals::knows(std::size_t surface, std::size_t n_nodes, std::span<const int> triangles) const {
  return surface < surfaces_.size() && surfaces_[surface].first_corner.size() == n_nodes + 1 &&
         std::ranges::equal(surfaces_[surface].triangles, triangles);
}

void NodeNormals::take_in(std::size_t n_nodes, std::span<const int> triangles, Surface& surface) {
  surface.triangles.assign(triangles.begin(), triangles.end());
  auto& first = surface.first_corner;
  first.assign(n_nodes + 1, 0);
  for (const int node : triangles) ++first[node + 1];
  for (std::size_t node = 0; node < n_nodes; ++node) first[node + 1] += first[node];
  auto next = first;
  surface.others.resize(2 * triangles.size());
  for (std::size_t t = 0; t < triangles.size(); t += 3) {
    for (int corner = 0; corner < 3; ++corner) {
      int* others = &surface.others[2 * next[triangles[t + corner]]++];
      others[0] = triangles[t + (corner + 1) % 3];
      others[1] = triangles[t + (corner + 2) % 3];
    }
  }
}

/// @return whether they are other ones, to the last bit, than those before
bool NodeNormals::take_in_positions(std::span<const std::span<const double>> positions) {
  bool are_others = positions_.size() != 3 * first_node_.back();
  positions_.resize(3 * first_node_.back());
  for (std::size_t s = 0; s < positions.size(); ++s) {
    double* known = positions_.data() + 3 * first_node_[s];
    if (positions[s].empty()) continue;
    if (!are_others && std::memcmp(known, positions[s].data(), positions[s].size_bytes()) == 0) continue;
    are_others = true;
    std::ranges::copy(positions[s], known);
  }
  return are_others;
}

std::span<const std::span<const double>> NodeNormals::find(std::span<const std::span<const double>> positions,
                                                           std::span<const std::span<const int>> triangles) {
  if (triangles.size() != positions.size()) {
    throw std::invalid_argument("coupler: positions and triangles are of " +
                                std::to_string(positions.size()) + " and " +
                                std::to_string(triangles.size()) + " surfaces");
  }
  const auto forget = [this] {  // what is found so far is of other triangles
    positions_.clear();
    of_surface_.clear();
  };
  if (surfaces_.size() != positions.size()) forget();
  surfaces_.resize(positions.size());
  first_node_.assign(1, 0);
  for (std::size_t s = 0; s < positions.size(); ++s) {
    const std::size_t n_nodes = positions[s].size() / 3;
    if (!knows(s, n_nodes, triangles[s])) {
      forget();
      require_surface(positions[s].size(), triangles[s], "normals", positions[s].size());
      take_in(n_nodes, triangles[s], surfaces_[s]);
    }
    first_node_.push_back(first_node_.back() + n_nodes);
  }
  if (!take_in_positions(positions) && !of_surface_.empty()) return of_surface_;
  normals_.resize(3 * first_node_.back());
  of_surface_.clear();
  for (std::size_t s = 0; s < positions.size(); ++s)
    of_surface_.emplace_back(normals_.data() + 3 * first_node_[s], normals_.data() + 3 * first_node_[s + 1]);
#pragma omp parallel for num_threads(n_threads_) schedule(static, 1)
  for (int share = 0; share < n_threads_; ++share) {
    const NodeRange range(first_node_.back(), share, n_threads_);
    SurfaceOfNode walk(first_node_);
    for (std::size_t m = range.begin; m < range.end; ++m) {
      const std::size_t s = walk.of(m);
      const int node = static_cast<int>(walk.node(m));
      const Surface& surface = surfaces_[s];
      double normal[3] = {0, 0, 0};
      for (std::size_t k = surface.first_corner[node]; k < surface.first_corner[node + 1]; ++k)
        add_normal(positions[s].data(), node, surface.others[2 * k], surface.others[2 * k + 1], normal);
      const double length = std::sqrt(dot(normal, normal));
      for (int axis = 0; axis < 3; ++axis) normals_[3 * m + axis] = normal[axis] / length;
    }
  }
  return of_surface_;
}

}  // namespace tanktread::coupler
