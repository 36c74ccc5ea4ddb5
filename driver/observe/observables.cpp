#include "driver/observe/observables.hpp"

#include <fmt/format.h>

#include "driver/system/phases.hpp"
#include "membrane/shape.hpp"

namespace tanktread::driver {

std::vector<Observation> observe(const System& system, const Case& the_case) {
  std::optional<int> iterations;
  if (any_implicit(system.membranes)) iterations = system.viscous_iterations;
  return observe(capsules_now(system), the_case, system.highest_speed, iterations);
}

std::vector<Observation> observe(const CapsulesNow& capsules, const Case& the_case, double max_speed,
                                 std::optional<int> viscous_iterations) {
  std::vector<Observation> observations;
  for (std::size_t k = 0; k < capsules.membranes.size(); ++k) {
    const auto& membrane = capsules.membranes[k];
    const auto& triangles = membrane.reference().triangles;
    const double radius = the_case.capsules[capsules.number(k)].radius;
    const auto moments = membrane::volume_moments(membrane.positions(), triangles);
    const auto shape = membrane::deformation(moments, the_case.flow.flow_axis, the_case.flow.wall_axis);
    Observation row;
    row.step = capsules.step;
    row.shear_time = capsules.shear_time();
    row.deformation = shape.deformation;
    row.inclination_deg = shape.inclination_deg;
    row.length = shape.length / radius;
    row.width = shape.width / radius;
    row.breadth = shape.breadth / radius;
    row.volume_ratio = moments.volume / membrane::volume_moments(membrane.start(), triangles).volume;
    row.area_ratio = membrane::surface_area(membrane.positions(), triangles) /
                     membrane::surface_area(membrane.start(), triangles);
    row.elastic_energy = membrane.elastic_energy();
    row.max_speed = max_speed;
    row.capsule = static_cast<int>(capsules.number(k));
    row.x = moments.centroid[0];
    row.y = moments.centroid[1];
    row.z = moments.centroid[2];
    row.viscous_iterations = viscous_iterations;
    observations.push_back(row);
  }
  return observations;
}

std::string observables_header(bool has_iterations) {
  return std::string(
             "step,shear_time,deformation,inclination_deg,length,width,breadth,volume_ratio,area_ratio,"
             "elastic_energy,max_speed,capsule,x,y,z") +
         (has_iterations ? ",viscous_iterations\n" : "\n");
}

std::string observables_row(const Observation& o) {
  std::string row = fmt::format("{}", o.step);
  for (const double value : {o.shear_time, o.deformation, o.inclination_deg, o.length, o.width, o.breadth,
                             o.volume_ratio, o.area_ratio, o.elastic_energy, o.max_speed}) {
    row += fmt::format(",{:.17g}", value);
  }
  row += fmt::format(",{},{:.17g},{:.17g},{:.17g}", o.capsule, o.x, o.y, o.z);
  if (o.viscous_iterations) row += fmt::format(",{}", *o.viscous_iterations);
  return row + "\n";
}

}  // namespace tanktread::driver
