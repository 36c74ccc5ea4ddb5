// What the tests of stencils with shear dipoles share.
#pragma once

#include <algorithm>
#include <cstring>

#include "tests/unit/coupler_support.hpp"

namespace tanktread::coupler::test {

inline bool same_bits(const Numbers& a, const Numbers& b) {
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0);
}

/// Surfaces, their unit normals, and the lengths of their dipoles.
struct Sheared {
  std::vector<Numbers> nodes, normals;
  Numbers lengths;

  void add(const Numbers& sphere_nodes, const Vector& centre, double length) {
    Numbers outwards;
    for (std::size_t k = 0; k < sphere_nodes.size(); k += 3) {
      Vector radius;
      for (int axis = 0; axis < 3; ++axis) radius[axis] = sphere_nodes[k + axis] - centre[axis];
      const double size = std::hypot(radius[0], radius[1], radius[2]);
      for (const double number : radius) outwards.push_back(number / size);
    }
    nodes.push_back(sphere_nodes);
    normals.push_back(outwards);
    lengths.push_back(length);
  }
  std::vector<std::size_t> sizes() const {
    std::vector<std::size_t> all;
    for (const auto& surface : nodes) all.push_back(surface.size() / 3);
    return all;
  }
  Sheared one(std::size_t surface) const {
    return {{nodes[surface]}, {normals[surface]}, {lengths[surface]}};
  }
};

inline void build(Coupler& coupler, const Sheared& sheared) {
  const std::vector<std::span<const double>> surfaces(sheared.nodes.begin(), sheared.nodes.end());
  std::vector<ShearDipole> dipoles;
  for (std::size_t s = 0; s < sheared.lengths.size(); ++s)
    dipoles.push_back({sheared.normals[s], sheared.lengths[s]});
  coupler.build(surfaces, dipoles);
}

using Matrix = std::array<Vector, 3>;

inline Vector times(const Matrix& a, const Vector& x) {
  Vector result = {};
  for (int c = 0; c < 3; ++c)
    for (int j = 0; j < 3; ++j) result[c] += a[c][j] * x[j];
  return result;
}

/// P (A + A^T) n.
inline Vector shear_of(const Matrix& a, const double* normal) {
  Vector result = {};
  double along = 0;
  for (int c = 0; c < 3; ++c) {
    for (int j = 0; j < 3; ++j) result[c] += (a[c][j] + a[j][c]) * normal[j];
    along += result[c] * normal[c];
  }
  for (int c = 0; c < 3; ++c) result[c] -= along * normal[c];
  return result;
}

}  // namespace tanktread::coupler::test
