#include "membrane/mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>

#include "membrane/element.hpp"
#include "membrane/mesh_parts.hpp"
#include "membrane/shape.hpp"

namespace tanktread::membrane {
namespace {

using Edge = std::array<int, 2>;

Edge edge_of(int a, int b) {
  return {std::min(a, b), std::max(a, b)};
}

/// The regular icosahedron on the unit sphere, counter-clockwise seen from outside.
TriangleMesh icosahedron() {
  const double golden = 0.5 * (1.0 + std::sqrt(5.0));
  TriangleMesh mesh;
  mesh.points.resize(3, 12);
  int node = 0;
  // Three golden rectangles, each in one coordinate plane.
  for (int axis = 0; axis < 3; ++axis) {
    for (const double a : {-1.0, 1.0}) {
      for (const double b : {-golden, golden}) {
        mesh.points.col(node).setZero();
        mesh.points((axis + 1) % 3, node) = a;
        mesh.points((axis + 2) % 3, node) = b;
        ++node;
      }
    }
  }
  // Faces: all triples of nodes at the edge length 2 from each other.
  const auto neighbours = [&](int a, int b) {
    return std::abs((mesh.points.col(a) - mesh.points.col(b)).norm() - 2.0) < 0.1;
  };
  mesh.triangles.resize(3, 20);
  int face = 0;
  for (int a = 0; a < 12; ++a) {
    for (int b = a + 1; b < 12; ++b) {
      for (int c = b + 1; c < 12; ++c) {
        if (!neighbours(a, b) || !neighbours(b, c) || !neighbours(a, c)) continue;
        const Eigen::Vector3d pa = mesh.points.col(a), pb = mesh.points.col(b), pc = mesh.points.col(c);
        const bool outward = (pb - pa).cross(pc - pa).dot(pa) > 0;
        mesh.triangles.col(face++) = outward ? Eigen::Vector3i(a, b, c) : Eigen::Vector3i(a, c, b);
      }
    }
  }
  mesh.points.colwise().normalize();
  return mesh;
}

/// Each triangle in four; new nodes at the middles of the edges, pushed out to the unit sphere.
TriangleMesh subdivided(const TriangleMesh& coarse) {
  std::map<Edge, int> middle_of;  // ordered: the node numbers do not depend on a hash
  std::vector<Eigen::Vector3d> added;
  const auto middle = [&](int a, int b) {
    const auto [entry, is_new] =
        middle_of.try_emplace(edge_of(a, b), static_cast<int>(coarse.points.cols() + added.size()));
    if (is_new) added.push_back((coarse.points.col(a) + coarse.points.col(b)).normalized());
    return entry->second;
  };
  TriangleMesh fine;
  fine.triangles.resize(3, 4 * coarse.triangles.cols());
  for (Eigen::Index t = 0; t < coarse.triangles.cols(); ++t) {
    const int a = coarse.triangles(0, t), b = coarse.triangles(1, t), c = coarse.triangles(2, t);
    const int ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    fine.triangles.col(4 * t) << a, ab, ca;
    fine.triangles.col(4 * t + 1) << b, bc, ab;
    fine.triangles.col(4 * t + 2) << c, ca, bc;
    fine.triangles.col(4 * t + 3) << ab, bc, ca;
  }
  fine.points.resize(3, coarse.points.cols() + static_cast<Eigen::Index>(added.size()));
  fine.points.leftCols(coarse.points.cols()) = coarse.points;
  for (std::size_t k = 0; k < added.size(); ++k)
    fine.points.col(coarse.points.cols() + static_cast<Eigen::Index>(k)) = added[k];
  return fine;
}

/// How often an edge is run through from its lower to its higher node, and the other way.
struct EdgeUse {
  int forward = 0, backward = 0;
};

std::map<Edge, EdgeUse> edge_uses(const Eigen::Matrix3Xi& triangles) {
  std::map<Edge, EdgeUse> uses;
  for (Eigen::Index t = 0; t < triangles.cols(); ++t) {
    for (int corner = 0; corner < 3; ++corner) {
      const int a = triangles(corner, t), b = triangles((corner + 1) % 3, t);
      auto& use = uses[edge_of(a, b)];
      ++(a < b ? use.forward : use.backward);
    }
  }
  return uses;
}

void check_indices(const TriangleMesh& mesh) {
  if (mesh.triangles.size() == 0) throw std::invalid_argument("mesh: it has no triangles");
  if (mesh.triangles.minCoeff() < 0 || mesh.triangles.maxCoeff() >= mesh.points.cols()) {
    throw std::invalid_argument("mesh: a triangle names a node outside 0 .. " +
                                std::to_string(mesh.points.cols() - 1));
  }
  if (!mesh.points.allFinite()) throw std::invalid_argument("mesh: a point is not finite");
}

void measure_edges(const TriangleMesh& mesh, MeshReport& report) {
  const auto uses = edge_uses(mesh.triangles);
  report.n_edges = static_cast<int>(uses.size());
  report.edge_min = std::numeric_limits<double>::max();
  report.closed = true;
  report.consistent_winding = true;
  for (const auto& [edge, use] : uses) {
    const double length = (mesh.points.col(edge[0]) - mesh.points.col(edge[1])).norm();
    report.edge_min = std::min(report.edge_min, length);
    report.edge_max = std::max(report.edge_max, length);
    report.edge_mean += length / static_cast<double>(uses.size());
    if (use.forward + use.backward != 2) report.closed = false;
    if (use.forward > 1 || use.backward > 1) report.consistent_winding = false;
  }
}

/// What adds up over parts says nothing of a part: a torus and a sphere have the Euler number of one sphere.
void measure_parts(const TriangleMesh& mesh, MeshReport& report) {
  const auto part = parts_of(mesh.triangles);
  const int n_parts = *std::ranges::max_element(part) + 1;
  if (n_parts == 1) {
    report.parts = {{report.n_triangles, report.euler_characteristic, report.volume}};
    return;
  }
  std::vector<std::vector<int>> triangles(n_parts);
  for (int t = 0; t < mesh.triangles.cols(); ++t) triangles[part[t]].push_back(t);
  for (const auto& numbers : triangles) {
    const auto alone = inspect({mesh.points, mesh.triangles(Eigen::all, numbers)});
    report.parts.push_back({alone.n_triangles, alone.euler_characteristic, alone.volume});
  }
}

/// " (of 320, 4 triangles)", the first few.
std::string sizes_text(const std::vector<MeshPart>& parts) {
  constexpr std::size_t n_most = 8;
  std::string text;
  for (std::size_t k = 0; k < std::min(n_most, parts.size()); ++k)
    text += (k == 0 ? "" : ", ") + std::to_string(parts[k].n_triangles);
  return "of " + text + (parts.size() > n_most ? " ... triangles" : " triangles");
}

}  // namespace

TriangleMesh icosphere(int level, double radius, const Eigen::Vector3d& centre) {
  if (level < 0 || level > 8)
    throw std::invalid_argument("icosphere: level " + std::to_string(level) + " is outside 0 .. 8");
  if (!(radius > 0) || !std::isfinite(radius)) {
    throw std::invalid_argument("icosphere: the radius is " + std::to_string(radius) +
                                ", must be positive and finite");
  }
  auto mesh = icosahedron();
  for (int k = 0; k < level; ++k) mesh = subdivided(mesh);
  mesh.points = (radius * mesh.points).colwise() + centre;
  return mesh;
}

MeshReport inspect(const TriangleMesh& mesh) {
  check_indices(mesh);
  MeshReport report;
  report.n_nodes = static_cast<int>(mesh.points.cols());
  report.n_triangles = static_cast<int>(mesh.triangles.cols());
  measure_edges(mesh, report);
  report.area = surface_area(mesh.points, mesh.triangles);
  const auto moments = volume_moments(mesh.points, mesh.triangles);
  report.volume = moments.volume;
  report.centre = moments.centroid;
  report.outward = report.closed && report.consistent_winding && report.volume > 0;

  std::vector<char> used(mesh.points.cols(), 0);
  for (Eigen::Index t = 0; t < mesh.triangles.cols(); ++t) {
    const Eigen::Vector3d normal = area_normal(corners_of(mesh.points, mesh.triangles.col(t)));
    if (0.5 * normal.norm() < 1e-12 * report.edge_max * report.edge_max) ++report.n_degenerate;
    for (int corner = 0; corner < 3; ++corner) used[mesh.triangles(corner, t)] = 1;
  }
  report.n_unused_nodes = static_cast<int>(std::count(used.begin(), used.end(), 0));
  report.euler_characteristic = report.n_nodes - report.n_unused_nodes - report.n_edges + report.n_triangles;
  report.n_pinched_nodes = count_pinched_nodes(mesh.triangles);
  measure_parts(mesh, report);
  return report;
}

std::vector<std::string> defects(const MeshReport& report) {
  std::vector<std::string> found;
  if (!report.closed) {
    found.push_back(
        "the surface is open (an edge does not have exactly two triangles); close it, or merge duplicate "
        "nodes");
  }
  if (!report.consistent_winding) {
    found.push_back("neighbouring triangles are wound against each other; orient all of them the same way");
  }
  // Of the flattest disc that can be run the ratio is a million times that.
  constexpr double least_volume = 1e-9;  // over the area^(3/2); of a sphere 0.094
  const bool is_whole = report.closed && report.consistent_winding && report.parts.size() == 1;
  if (report.closed && report.parts.size() > 1) {
    found.push_back("the surface is " + std::to_string(report.parts.size()) + " separate parts (" +
                    sizes_text(report.parts) +
                    "); a membrane is one closed surface: give each part a mesh of its own");
  }
  if (is_whole && std::abs(report.volume) <= least_volume * std::pow(report.area, 1.5)) {
    found.push_back("the surface encloses no volume; make it a body");
  } else if (is_whole && report.volume < 0) {
    found.push_back("the surface is inside out (volume " + std::to_string(report.volume) +
                    "); reverse every triangle");
  }
  if (report.closed && report.n_pinched_nodes > 0) {
    found.push_back("surfaces touch each other in " + std::to_string(report.n_pinched_nodes) +
                    " nodes without an edge in common; part them there");
  } else if (is_whole && report.euler_characteristic != 2) {
    found.push_back("the surface is not one sphere (nodes - edges + triangles is " +
                    std::to_string(report.euler_characteristic) + ", must be 2); fill its handles");
  }
  if (report.n_degenerate > 0) {
    found.push_back(std::to_string(report.n_degenerate) +
                    " triangles have no area; remove them and merge their nodes");
  }
  if (report.n_unused_nodes > 0) {
    found.push_back(std::to_string(report.n_unused_nodes) + " nodes belong to no triangle; remove them");
  }
  return found;
}

}  // namespace tanktread::membrane
