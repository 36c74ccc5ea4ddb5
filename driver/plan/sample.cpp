#include "driver/plan/sample.hpp"

#include <algorithm>
#include <cmath>

#include "driver/system/capsule_shape.hpp"

namespace tanktread::driver {
namespace {

using Meshes = std::vector<membrane::TriangleMesh>;

/// The capsule with the most nodes.
std::size_t largest_of(const Meshes& meshes) {
  const auto found = std::ranges::max_element(
      meshes, {}, [](const membrane::TriangleMesh& mesh) { return mesh.points.cols(); });
  return static_cast<std::size_t>(found - meshes.begin());
}

}  // namespace

Case sample_of(const Case& the_case, const Meshes& meshes) {
  constexpr int most_nodes = 96;
  constexpr double least_lengths = 3;
  Case sample = the_case;
  sample.output.fluid_box.reset();
  sample.capsules.clear();
  Eigen::Array3d length = Eigen::Array3d::Zero();
  if (!meshes.empty()) {
    const auto k = largest_of(meshes);
    const auto& points = meshes[k].points;
    length = (points.rowwise().maxCoeff() - points.rowwise().minCoeff()).array();
    sample.capsules.push_back(the_case.capsules[k]);
  }
  for (int axis = 0; axis < 3; ++axis) {
    int& n = sample.flow.box[axis];
    n = std::min(n, std::max(most_nodes, static_cast<int>(std::ceil(least_lengths * length[axis]))));
    for (auto& capsule : sample.capsules) capsule.position[axis] = 0.5 * n;
  }
  return sample;
}

Probe try_sample(const Case& the_case, const Parameters& parameters, const Meshes& meshes) {
  const auto sample = sample_of(the_case, meshes);
  auto of_sample = parameters;
  if (!meshes.empty()) of_sample.capsules = {parameters.capsules[largest_of(meshes)]};
  // The shear rate is that of the case, so that a step is as usual for the capsule.
  const int axis = the_case.flow.wall_axis;
  of_sample.wall_speed *= static_cast<double>(sample.flow.box[axis]) / the_case.flow.box[axis];
  const auto tried = try_case(sample, of_sample, membrane_shapes(sample));
  Probe probe;
  probe.breakdown = tried.breakdown;
  if (tried.mlups == 0) return probe;
  probe.fluid_node_seconds = tried.fluid_node_seconds;
  probe.membrane_node_seconds = tried.membrane_node_seconds;
  double nodes = 1, membrane_nodes = 0;
  for (const int n : the_case.flow.box) nodes *= n;
  for (const auto& mesh : meshes) membrane_nodes += static_cast<double>(mesh.points.cols());
  probe.mlups =
      1e-6 * nodes / (nodes * probe.fluid_node_seconds + membrane_nodes * probe.membrane_node_seconds);
  return probe;
}

}  // namespace tanktread::driver
