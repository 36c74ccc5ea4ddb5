#include "coupler/volume.hpp"

#include <array>
#include <cmath>
#include <vector>

#include "coupler/surface_check.hpp"

namespace tanktread::coupler {
namespace {

using Vector = std::array<double, 3>;

Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

double dot(const Vector& a, const Vector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Six times a tetrahedron's volume.
double volume_of(const Vector& a, const Vector& b, const Vector& c) {
  return dot(a, cross(b, c));
}

/// A node's place from the first node of the surface, which spares digits far from the origin.
struct Places {
  std::span<const double> positions;

  Vector operator[](int node) const {
    const std::size_t k = 3 * static_cast<std::size_t>(node);
    return {positions[k] - positions[0], positions[k + 1] - positions[1], positions[k + 2] - positions[2]};
  }
};

/// Six times A.
std::vector<double> gradient_of(const Places& at, std::span<const int> triangles) {
  std::vector<double> gradient(at.positions.size());
  for (std::size_t t = 0; t < triangles.size(); t += 3) {
    for (int corner = 0; corner < 3; ++corner) {
      const Vector part = cross(at[triangles[t + (corner + 1) % 3]], at[triangles[t + (corner + 2) % 3]]);
      for (int axis = 0; axis < 3; ++axis) gradient[3 * triangles[t + corner] + axis] += part[axis];
    }
  }
  return gradient;
}

/// Six times V(x + v) - V(x).
double change_of_volume(const Places& at, std::span<const int> triangles, std::span<const double> velocity) {
  double change = 0;
  for (std::size_t t = 0; t < triangles.size(); t += 3) {
    std::array<Vector, 3> before, after;
    for (int corner = 0; corner < 3; ++corner) {
      before[corner] = after[corner] = at[triangles[t + corner]];
      for (int axis = 0; axis < 3; ++axis) after[corner][axis] += velocity[3 * triangles[t + corner] + axis];
    }
    change += volume_of(after[0], after[1], after[2]) - volume_of(before[0], before[1], before[2]);
  }
  return change;
}

}  // namespace

void keep_volume(std::span<const double> positions, std::span<const int> triangles,
                 std::span<double> velocity) {
  require_surface(positions.size(), triangles, "velocities", velocity.size());
  const Places at{positions};
  const auto gradient = gradient_of(at, triangles);
  double squares = 0;
  for (const double component : gradient) squares += component * component;
  if (squares == 0) return;  // a surface without a triangle
  // The first leaves the change times the strain of a step, the second the square of that.
  for (int iteration = 0; iteration < 2; ++iteration) {
    const double factor = change_of_volume(at, triangles, velocity) / squares;
    if (!std::isfinite(factor)) return;  // by one node, whose own velocity shall say so
    for (std::size_t k = 0; k < velocity.size(); ++k) velocity[k] -= factor * gradient[k];
  }
}

}  // namespace tanktread::coupler
