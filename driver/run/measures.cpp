#include "driver/run/measures.hpp"

#include <fmt/format.h>

#include <numbers>

#include "membrane/contour.hpp"
#include "membrane/shape.hpp"

namespace tanktread::driver {
namespace {

Eigen::Index marker_of(const CapsuleMembrane& membrane, int flow_axis, double radius) {
  const auto moments = membrane::volume_moments(membrane.start(), membrane.reference().triangles);
  return membrane::nearest_node(membrane.start(),
                                moments.centroid + radius * Eigen::Vector3d::Unit(flow_axis));
}

}  // namespace

std::vector<Measures> measure(const System& system, const Case& the_case) {
  const int flow_axis = the_case.flow.flow_axis;
  const int vorticity_axis = 3 - flow_axis - the_case.flow.wall_axis;
  std::vector<Measures> all;
  for (std::size_t k = 0; k < system.membranes.size(); ++k) {
    const auto& membrane = system.membranes[k];
    const auto& triangles = membrane.reference().triangles;
    const auto& points = membrane.positions();
    const auto& velocity = system.node_velocity[k];
    const double radius = the_case.capsules[k].radius;
    const auto moments = membrane::volume_moments(points, triangles);
    const auto frame = membrane::centroid_velocity(moments, points, triangles, velocity);
    const auto contour =
        membrane::contour(points, triangles, vorticity_axis, moments.centroid[vorticity_axis]);
    const auto along_vorticity = points.row(vorticity_axis);
    Measures row;
    row.step = system.step;
    row.shear_time = system.shear_time();
    row.capsule = static_cast<int>(k);
    row.circumference = membrane::contour_length(points, contour) / (2 * std::numbers::pi * radius);
    row.membrane_speed =
        membrane::mean_speed(points, velocity, contour, vorticity_axis, frame) / (system.shear_rate * radius);
    row.vorticity_extent = (along_vorticity.maxCoeff() - along_vorticity.minCoeff()) / (2 * radius);
    row.marker = (points.col(marker_of(membrane, flow_axis, radius)) - moments.centroid) / radius;
    all.push_back(row);
  }
  return all;
}

std::string measures_header() {
  return "step,shear_time,capsule,circumference,membrane_speed,vorticity_extent,marker_x,marker_y,"
         "marker_z\n";
}

std::string measures_row(const Measures& m) {
  return fmt::format("{},{:.17g},{},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g}\n", m.step, m.shear_time,
                     m.capsule, m.circumference, m.membrane_speed, m.vorticity_extent, m.marker[0],
                     m.marker[1], m.marker[2]);
}

}  // namespace tanktread::driver
