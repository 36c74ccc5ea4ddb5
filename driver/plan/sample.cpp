#include "driver/plan/sample.hpp"

#include <algorithm>
#include <cmath>

#include "driver/system/capsule_shape.hpp"

namespace tanktread::driver {
namespace {

/// The capsule with the most nodes.
std::size_t largest_of(std::span<const MeshSize> sizes) {
  return static_cast<std::size_t>(std::ranges::max_element(sizes, {}, &MeshSize::n_nodes) - sizes.begin());
}

}  // namespace

Case sample_of(const Case& the_case, std::span<const MeshSize> sizes, const ShapeSource& shape_of) {
  constexpr int most_nodes = 96;
  constexpr double least_lengths = 3;
  Case sample = the_case;
  sample.output.fluid_box.reset();
  sample.capsules.clear();
  Eigen::Array3d length = Eigen::Array3d::Zero();
  if (!sizes.empty()) {
    const auto k = largest_of(sizes);
    const auto points = shape_of(k).mesh.points;
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

Probe try_sample(const Case& the_case, const Parameters& parameters, std::span<const MeshSize> sizes,
                 const ShapeSource& shape_of) {
  const auto sample = sample_of(the_case, sizes, shape_of);
  auto of_sample = parameters;
  if (!sizes.empty()) of_sample.capsules = {parameters.capsules[largest_of(sizes)]};
  // The shear rate is that of the case, so that a step is as usual for the capsule.
  const int axis = the_case.flow.wall_axis;
  of_sample.wall_speed *= static_cast<double>(sample.flow.box[axis]) / the_case.flow.box[axis];
  const auto tried = try_case(sample, of_sample, membrane_shapes(sample), Sharing::alone);
  Probe probe;
  probe.breakdown = tried.breakdown;
  if (tried.mlups == 0) return probe;
  probe.fluid_node_seconds = tried.fluid_node_seconds;
  probe.membrane_node_seconds = tried.membrane_node_seconds;
  double nodes = 1, membrane_nodes = 0;
  for (const int n : the_case.flow.box) nodes *= n;
  for (const auto& size : sizes) membrane_nodes += static_cast<double>(size.n_nodes);
  probe.mlups =
      1e-6 * nodes / (nodes * probe.fluid_node_seconds + membrane_nodes * probe.membrane_node_seconds);
  return probe;
}

}  // namespace tanktread::driver
