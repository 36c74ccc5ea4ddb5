#include "driver/system.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "driver/laws.hpp"
#include "driver/surface_mesh.hpp"
#include "exchange/vtk_files.hpp"
#include "fluid/lattice_boltzmann.hpp"

namespace tanktread::driver {
namespace {

std::unique_ptr<fluid::Fluid> make_fluid(const Case& the_case, const Parameters& parameters) {
  const auto& flow = the_case.flow;
  fluid::LatticeBoltzmannSettings settings;
  settings.shape = {flow.box[0], flow.box[1], flow.box[2]};
  settings.relaxation_time = parameters.relaxation_time;
  settings.magic_parameter.reset();
  if (flow.collision == "trt") settings.magic_parameter = flow.magic_parameter;
  settings.inertia = flow.inertia;
  settings.body_force = parameters.body_force;
  settings.start = flow.start == "developed" ? fluid::Start::developed : fluid::Start::rest;
  settings.speed_limit = flow.speed_limit;
  settings.threads = the_case.run.threads;
  if (flow.kind != "periodic") {
    fluid::WallPair walls;
    walls.axis = flow.wall_axis;
    if (flow.kind == "shear") {
      walls.low_velocity[flow.flow_axis] = -parameters.wall_speed;
      walls.high_velocity[flow.flow_axis] = parameters.wall_speed;
    }
    settings.walls = walls;
  }
  return fluid::make_lattice_boltzmann(settings);
}

membrane::TriangleMesh mesh_from_file(const CapsuleCase& capsule) {
  const auto file = std::filesystem::path(capsule.mesh.file);
  membrane::TriangleMesh mesh;
  try {
    mesh = to_mesh(exchange::read_surface(file, true));
  } catch (const exchange::FileError& error) {
    throw InputError(error.what());
  }
  const auto report = inspected(mesh, file.string());
  require_no_defects(report, file.string());
  const double sphere_volume = 4.0 / 3.0 * std::numbers::pi * std::pow(capsule.radius, 3);
  const double scale = std::cbrt(sphere_volume / report.volume);
  const Eigen::Vector3d position(capsule.position[0], capsule.position[1], capsule.position[2]);
  mesh.points = (scale * (mesh.points.colwise() - report.centre)).colwise() + position;
  return mesh;
}

}  // namespace

membrane::TriangleMesh reference_mesh(const CapsuleCase& capsule) {
  if (!capsule.mesh.file.empty()) return mesh_from_file(capsule);
  return membrane::icosphere(capsule.mesh.level, capsule.radius,
                             {capsule.position[0], capsule.position[1], capsule.position[2]});
}

System make_system(const Case& the_case, const Parameters& parameters,
                   const std::vector<membrane::TriangleMesh>& meshes) {
  System system;
  system.fluid = make_fluid(the_case, parameters);
  coupler::Grid grid{the_case.flow.box, {true, true, true}};
  if (the_case.flow.kind != "periodic") grid.periodic[the_case.flow.wall_axis] = false;
  system.coupler = std::make_unique<coupler::Coupler>(grid, coupler::kernel(the_case.coupler.kernel),
                                                      the_case.run.threads);
  for (std::size_t k = 0; k < meshes.size(); ++k) {
    system.membranes.emplace_back(meshes[k],
                                  elastic_law(the_case.capsules[k].membrane, parameters.capsules[k]),
                                  viscous_law(parameters.capsules[k]), the_case.run.threads);
    system.node_velocity.emplace_back(Eigen::Matrix3Xd::Zero(3, meshes[k].points.cols()));
    system.node_force.emplace_back(Eigen::Matrix3Xd::Zero(3, meshes[k].points.cols()));
  }
  try {
    build_stencils(system);
  } catch (const coupler::StencilError& error) {
    throw InputError(
        fmt::format("{}; move the capsule (capsule.N.position) or enlarge flow.box", error.what()));
  }
  return system;
}

void build_stencils(System& system) {
  std::vector<std::span<const double>> surfaces;
  for (const auto& membrane : system.membranes) {
    surfaces.emplace_back(membrane.positions().data(), membrane.positions().size());
  }
  system.coupler->build(surfaces);
}

}  // namespace tanktread::driver
