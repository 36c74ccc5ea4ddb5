// Surfaces, movements and rounding bounds that the tests of the membrane share.
#pragma once

#include <Eigen/Core>
#include <cstring>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>

#include "membrane/membrane.hpp"

namespace tanktread::membrane::test {

/// Skalak's law with G_s = 1, C = 1.
std::shared_ptr<const ElasticLaw> skalak();

template <typename A, typename B>
bool same_bits(const A& a, const B& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

constexpr double epsilon = std::numeric_limits<double>::epsilon();

/// A cube of edge `edge` with a corner in the origin, two triangles a face. Rows 0 to 11 of `face_axis` are
/// the axis that the face of each triangle is normal to.
struct Cube {
  TriangleMesh mesh;
  Eigen::VectorXi face_axis;
};
Cube cube(double edge);

/// Each coordinate moved by an equally distributed random distance within +-amplitude; the same on every
/// machine.
Eigen::Matrix3Xd randomly_moved(const Eigen::Matrix3Xd& points, double amplitude, unsigned seed);

/// A smooth deformation without any symmetry, of strains up to about 0.5.
Eigen::Matrix3Xd smoothly_deformed(const Eigen::Matrix3Xd& points);

Eigen::Matrix3d rotation(const Eigen::Vector3d& axis, double angle);

Eigen::Matrix3Xd forces(Membrane& membrane, const Eigen::Matrix3Xd& positions);

/// Reverses every triangle.
TriangleMesh turned_inside_out(TriangleMesh mesh);

/// Rounding of an entry of F at these positions: each is a sum of three products of a coordinate and a shape
/// gradient (at most about 1/height), rounded 3 times, besides the rounding of the gradient and of the
/// coordinate itself (8 together); 3 terms times 8 roundings times half an epsilon is 12 epsilon |x|/height.
double gradient_rounding(const TriangleMesh& reference, const Eigen::Matrix3Xd& positions);

/// The message of the std::invalid_argument that an action throws.
template <typename Action>
std::string refusal_message(Action action) {
  try {
    action();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "nothing was thrown";
}

}  // namespace tanktread::membrane::test
