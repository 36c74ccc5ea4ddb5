#include "driver/output.hpp"

namespace tanktread::driver {
namespace {

using exchange::Array;

void append(std::vector<double>& values, const double* data, Eigen::Index size) {
  values.insert(values.end(), data, data + size);
}

std::vector<Array> time_data(const System& system, double shear_time) {
  return {{"step", 1, {static_cast<double>(system.step)}}, {"shear_time", 1, {shear_time}}};
}

}  // namespace

exchange::SurfacePacket membrane_packet(const System& system, double shear_time) {
  exchange::SurfacePacket packet;
  Array velocity{"velocity", 3, {}}, elastic_force{"elastic_force", 3, {}}, total_force{"total_force", 3, {}};
  Array stretches{"principal_stretches", 2, {}}, stress{"stress", 9, {}};
  Array viscous_stress{"viscous_stress", 9, {}}, area_ratio{"area_ratio", 1, {}};
  Array capsule{"capsule", 1, {}};
  for (std::size_t k = 0; k < system.membranes.size(); ++k) {
    const auto& membrane = system.membranes[k];
    const auto first_node = static_cast<std::int64_t>(packet.points.size() / 3);
    append(packet.points, membrane.positions().data(), membrane.positions().size());
    const auto& triangles = membrane.reference().triangles;
    for (Eigen::Index corner = 0; corner < triangles.size(); ++corner) {
      packet.triangles.push_back(first_node + triangles.data()[corner]);
    }
    Eigen::Matrix3Xd elastic = Eigen::Matrix3Xd::Zero(3, membrane.n_nodes());
    membrane.add_elastic_forces(elastic);
    append(velocity.values, system.node_velocity[k].data(), system.node_velocity[k].size());
    append(elastic_force.values, elastic.data(), elastic.size());
    append(total_force.values, system.node_force[k].data(), system.node_force[k].size());
    const auto fields = membrane.element_fields();
    append(stretches.values, fields.principal_stretches.data(), fields.principal_stretches.size());
    append(stress.values, fields.stress.data(), fields.stress.size());
    append(viscous_stress.values, fields.viscous_stress.data(), fields.viscous_stress.size());
    append(area_ratio.values, fields.area_ratio.data(), fields.area_ratio.size());
    capsule.values.insert(capsule.values.end(), membrane.n_triangles(), static_cast<double>(k));
  }
  packet.point_data = {std::move(velocity), std::move(elastic_force), std::move(total_force)};
  packet.cell_data = {std::move(stretches), std::move(stress), std::move(viscous_stress),
                      std::move(area_ratio), std::move(capsule)};
  packet.field_data = time_data(system, shear_time);
  return packet;
}

exchange::GridPacket fluid_packet(const System& system, const Case& the_case, double shear_time) {
  const auto shape = system.fluid->shape();
  std::vector<double> all_density(shape.size()), all_velocity(3 * shape.size());
  system.fluid->moments(all_density, all_velocity);
  const auto all_force = system.fluid->force();

  std::array<std::array<int, 2>, 3> box = {{{0, shape.nx - 1}, {0, shape.ny - 1}, {0, shape.nz - 1}}};
  if (the_case.output.fluid_box) box = *the_case.output.fluid_box;
  exchange::GridPacket packet;
  std::int64_t n_nodes = 1;
  for (int axis = 0; axis < 3; ++axis) {
    packet.nodes[axis] = box[axis][1] - box[axis][0] + 1;
    packet.origin[axis] = box[axis][0] + 0.5;
    n_nodes *= packet.nodes[axis];
  }
  Array density{"density", 1, {}}, velocity{"velocity", 3, {}}, force{"force", 3, {}};
  density.values.reserve(n_nodes);
  velocity.values.reserve(3 * n_nodes);
  force.values.reserve(3 * n_nodes);
  for (int z = box[2][0]; z <= box[2][1]; ++z) {
    for (int y = box[1][0]; y <= box[1][1]; ++y) {
      const std::int64_t first = shape.index(box[0][0], y, z);
      append(density.values, &all_density[first], packet.nodes[0]);
      append(velocity.values, &all_velocity[3 * first], 3 * packet.nodes[0]);
      append(force.values, &all_force[3 * first], 3 * packet.nodes[0]);
    }
  }
  packet.point_data = {std::move(density), std::move(velocity), std::move(force)};
  packet.field_data = time_data(system, shear_time);
  return packet;
}

}  // namespace tanktread::driver
