#include "unit/membrane_support.hpp"

#include <Eigen/Geometry>
#include <random>

namespace tanktread::membrane::test {

std::shared_ptr<const ElasticLaw> skalak() {
  return make_elastic_law("skalak", {.shear_modulus = 1, .area_ratio = 1});
}

Cube cube(double edge) {
  Cube result;
  result.mesh.points.resize(3, 8);
  for (int node = 0; node < 8; ++node)
    result.mesh.points.col(node) = edge * Eigen::Vector3d(node & 1, (node >> 1) & 1, (node >> 2) & 1);
  result.mesh.triangles.resize(3, 12);
  result.face_axis.resize(12);
  int t = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const int step1 = 1 << (axis + 1) % 3, step2 = 1 << (axis + 2) % 3;
    for (const int first : {0, 1 << axis}) {
      const int a = first, b = first + step1, c = first + step1 + step2, d = first + step2;
      result.face_axis.segment<2>(t).setConstant(axis);
      const bool outward = first != 0;  // a, b, c turns about the positive axis
      for (const auto& triangle : {Eigen::Vector3i(a, b, c), Eigen::Vector3i(a, c, d)}) {
        result.mesh.triangles.col(t++) =
            outward ? triangle : Eigen::Vector3i(triangle[0], triangle[2], triangle[1]);
      }
    }
  }
  return result;
}

Eigen::Matrix3Xd randomly_moved(const Eigen::Matrix3Xd& points, double amplitude, unsigned seed) {
  std::mt19937 random(seed);
  Eigen::Matrix3Xd moved = points;
  for (Eigen::Index k = 0; k < moved.size(); ++k)
    moved.data()[k] += amplitude * (2.0 * random() / std::mt19937::max() - 1.0);
  return moved;
}

Eigen::Matrix3Xd smoothly_deformed(const Eigen::Matrix3Xd& points) {
  Eigen::Matrix3Xd moved = points;
  for (Eigen::Index k = 0; k < points.cols(); ++k) {
    const double x = points(0, k), y = points(1, k), z = points(2, k);
    moved.col(k) += Eigen::Vector3d(0.2 * std::sin(y + 0.3) + 0.1 * x * z, 0.15 * std::cos(x - z),
                                    0.1 * x * y - 0.12 * z + 0.05 * z * z);
  }
  return moved;
}

Eigen::Matrix3d rotation(const Eigen::Vector3d& axis, double angle) {
  return Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
}

Eigen::Matrix3Xd forces(Membrane& membrane, const Eigen::Matrix3Xd& positions) {
  membrane.set_positions(positions);
  Eigen::Matrix3Xd force = Eigen::Matrix3Xd::Zero(3, positions.cols());
  membrane.add_forces(force);
  return force;
}

TriangleMesh turned_inside_out(TriangleMesh mesh) {
  const Eigen::RowVectorXi second = mesh.triangles.row(1);
  mesh.triangles.row(1) = mesh.triangles.row(2);
  mesh.triangles.row(2) = second;
  return mesh;
}

double gradient_rounding(const TriangleMesh& reference, const Eigen::Matrix3Xd& positions) {
  double least_height = std::numeric_limits<double>::max();
  for (Eigen::Index t = 0; t < reference.triangles.cols(); ++t) {
    const Eigen::Vector3d a = reference.points.col(reference.triangles(0, t));
    const Eigen::Vector3d b = reference.points.col(reference.triangles(1, t));
    const Eigen::Vector3d c = reference.points.col(reference.triangles(2, t));
    const double longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
    least_height = std::min(least_height, (b - a).cross(c - a).norm() / longest);
  }
  return 12.0 * epsilon * positions.colwise().norm().maxCoeff() / least_height;
}

}  // namespace tanktread::membrane::test
