#include "driver/observe/measures.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <string>

#include "driver/units/mesh_axis.hpp"
#include "membrane/contour.hpp"
#include "membrane/node_areas.hpp"
#include "membrane/orientation.hpp"
#include "membrane/shape.hpp"

namespace tanktread::driver {
namespace {

Eigen::Index marker_of(const CapsuleMembrane& membrane, int flow_axis, double radius) {
  const auto moments = membrane::volume_moments(membrane.start(), membrane.reference().triangles);
  return membrane::nearest_node(membrane.start(),
                                moments.centroid + radius * Eigen::Vector3d::Unit(flow_axis));
}

/// Of a direction in the shear plane, degrees; 0 across the plane.
double inclination_deg(const Eigen::Vector3d& direction, const FlowCase& flow) {
  return std::atan2(direction[flow.wall_axis], direction[flow.flow_axis]) * 180 / std::numbers::pi;
}

/// Of the two senses of an axis the one towards the upper wall; along the walls, that of the flow.
Eigen::Vector3d upwards(const Eigen::Vector3d& axis, const FlowCase& flow) {
  const int vorticity_axis = 3 - flow.flow_axis - flow.wall_axis;
  for (const int along : {flow.wall_axis, flow.flow_axis, vorticity_axis})
    if (axis[along] != 0) return axis[along] > 0 ? axis : -axis;
  return axis;
}

void measure_extents(const LoadCase& load, const Eigen::Matrix3Xd& points, double radius, Measures& row) {
  const auto along =
      Eigen::Vector3d(load.direction[0], load.direction[1], load.direction[2]).stableNormalized();
  row.axial_diameter = membrane::extent_along(points, along) / (2 * radius);
  row.transverse_diameter = membrane::largest_extent_across(points, along) / (2 * radius);
}

/// @param start the mesh that the capsule started as
void measure_axes(const MeshCase& mesh, const membrane::TriangleMesh& start, const Eigen::Matrix3Xd& points,
                  const membrane::VolumeMoments& moments, const FlowCase& flow, Measures& row) {
  const auto areas = membrane::node_areas(start.points, start.triangles);
  row.axis = membrane::carried_direction(start.points, areas, mesh_axis(mesh), points).normalized();
  row.axis_inclination_deg = inclination_deg(row.axis, flow);
  row.short_axis = upwards(membrane::shortest_axis(moments), flow);
  const double inclination = inclination_deg(row.short_axis, flow);  // in [0, 180]
  row.short_inclination_deg = inclination > 90 ? inclination - 180 : inclination;
}

}  // namespace

std::vector<Measures> measure(const System& system, const Case& the_case) {
  return measure(capsules_now(system), the_case);
}

std::vector<Measures> measure(const CapsulesNow& capsules, const Case& the_case) {
  const int flow_axis = the_case.flow.flow_axis;
  const int vorticity_axis = 3 - flow_axis - the_case.flow.wall_axis;
  std::vector<Measures> all;
  for (std::size_t k = 0; k < capsules.membranes.size(); ++k) {
    const auto& membrane = capsules.membranes[k];
    const auto& capsule = the_case.capsules[capsules.number(k)];
    const auto& triangles = membrane.reference().triangles;
    const auto& points = membrane.positions();
    const auto& velocity = capsules.velocity[k];
    const double radius = capsule.radius;
    const auto moments = membrane::volume_moments(points, triangles);
    const auto frame = membrane::centroid_velocity(moments, points, triangles, velocity);
    const auto contour =
        membrane::contour(points, triangles, vorticity_axis, moments.centroid[vorticity_axis]);
    const auto along_vorticity = points.row(vorticity_axis);
    Measures row;
    row.step = capsules.step;
    row.shear_time = capsules.shear_time();
    row.capsule = static_cast<int>(capsules.number(k));
    row.circumference = membrane::contour_length(points, contour) / (2 * std::numbers::pi * radius);
    row.membrane_speed = membrane::mean_speed(points, velocity, contour, vorticity_axis, frame) /
                         (capsules.shear_rate * radius);
    row.vorticity_extent = (along_vorticity.maxCoeff() - along_vorticity.minCoeff()) / (2 * radius);
    const membrane::TriangleMesh start{membrane.start(), triangles};
    row.marker = (points.col(marker_of(membrane, flow_axis, radius)) - moments.centroid) / radius;
    measure_extents(capsule.load, points, radius, row);
    measure_axes(capsule.mesh, start, points, moments, the_case.flow, row);
    all.push_back(row);
  }
  return all;
}

std::string measures_header() {
  return "step,shear_time,capsule,circumference,membrane_speed,vorticity_extent,marker_x,marker_y,"
         "marker_z,axial_diameter,transverse_diameter,axis_x,axis_y,axis_z,axis_inclination_deg,"
         "short_axis_x,short_axis_y,short_axis_z,short_inclination_deg\n";
}

std::string measures_row(const Measures& m) {
  std::string row = fmt::format("{},{:.17g},{}", m.step, m.shear_time, m.capsule);
  for (const double value :
       {m.circumference, m.membrane_speed, m.vorticity_extent, m.marker[0], m.marker[1], m.marker[2],
        m.axial_diameter, m.transverse_diameter, m.axis[0], m.axis[1], m.axis[2], m.axis_inclination_deg,
        m.short_axis[0], m.short_axis[1], m.short_axis[2], m.short_inclination_deg})
    row += fmt::format(",{:.17g}", value);
  return row + "\n";
}

}  // namespace tanktread::driver
