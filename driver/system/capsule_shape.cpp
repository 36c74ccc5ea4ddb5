#include "driver/system/capsule_shape.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <optional>

#include "driver/case/case_geometry.hpp"
#include "driver/packets/field_number.hpp"
#include "driver/packets/surface_mesh.hpp"
#include "driver/system/placement.hpp"
#include "exchange/vtk_files.hpp"
#include "membrane/revolved_mesh.hpp"
#include "membrane/rotation.hpp"
#include "membrane/shape.hpp"

namespace tanktread::driver {
namespace {

/// A file that a shape is from, and what the case says of it.
struct ShapeFile {
  std::string key;  ///< of the path, "capsule.0.mesh.file"
  std::string path, hash;
};

ShapeFile mesh_file(const Case& the_case, std::size_t number) {
  const auto& mesh = the_case.capsules[number].mesh;
  return {fmt::format("capsule.{}.mesh.file", number), mesh.file, mesh.file_hash};
}

ShapeFile stress_free_file(const Case& the_case, std::size_t number) {
  const auto& stress_free = the_case.capsules[number].stress_free;
  return {fmt::format("capsule.{}.stress_free.file", number), stress_free.file, stress_free.file_hash};
}

/// The file that the stress-free shape is from; its path is empty if there is none.
ShapeFile file_of_stress_free(const Case& the_case, std::size_t number) {
  const bool is_own = has_own_stress_free_shape(the_case.capsules[number]);
  return is_own ? stress_free_file(the_case, number) : mesh_file(the_case, number);
}

exchange::SurfacePacket read_shape_file(const ShapeFile& file) {
  try {
    return exchange::read_surface(file.path, true);
  } catch (const exchange::FileError& error) {
    throw InputError(error.what());
  }
}

/// The file that a case was made with may have been changed since. @throws InputError
void check_hash(const Case& the_case, const ShapeFile& file, const std::string& hash) {
  if (file.hash.empty() || file.hash == hash) return;
  throw InputError(
      fmt::format("{0}: {1}_hash = \"{2}\", but {3} has the hash \"{4}\": it is not the surface that the "
                  "case was made with; put that file back, or say that this one is meant: with --set "
                  "{1}_hash={4}, or without the key",
                  the_case.file.string(), file.key, file.hash, file.path, hash));
}

/// A state says itself that its points are not the stress-free shape, so taking them for it is a mistake;
/// other deformed shapes may be meant (remarks_on_mesh_files).
void require_no_deformed_state(const exchange::SurfacePacket& packet, const ShapeFile& file) {
  const auto* reference = exchange::find_optional_array(packet.point_data, "reference_position");
  if (reference == nullptr || reference->values == packet.points) return;
  throw InputError(
      fmt::format("{}: is the state of a deformed membrane, whose stress-free shape is its array "
                  "reference_position, not its points; name the mesh that the run was made with, or "
                  "membrane_0000000000.vtu of its output",
                  file.path));
}

/// The surface in a file, its centre moved to the origin.
struct FileSurface {
  membrane::TriangleMesh mesh;
  double volume = 0;
  std::string hash;
};

FileSurface surface_from(const Case& the_case, const ShapeFile& file, bool is_stress_free) {
  const auto packet = read_shape_file(file);
  FileSurface surface{to_mesh(packet), 0, geometry_hash(packet)};
  check_hash(the_case, file, surface.hash);
  if (is_stress_free) require_no_deformed_state(packet, file);
  const auto report = inspected(surface.mesh, file.path);
  require_no_defects(report, file.path);
  surface.volume = report.volume;
  surface.mesh.points.colwise() -= report.centre;
  return surface;
}

/// A shape of MeshCase or StressFreeCase around the origin, but for the sphere.
template <typename Part>
membrane::Meridian meridian_of(const Part& part, double radius) {
  if (part.shape == "biconcave") return membrane::biconcave_meridian(radius);
  const double aspect_ratio = part.aspect_ratio ? *part.aspect_ratio
                                                : membrane::spheroid_aspect_ratio(part.reduced_volume.value(),
                                                                                  membrane::Spheroid::oblate);
  return membrane::spheroid_meridian(radius, aspect_ratio);
}

template <typename Part>
membrane::TriangleMesh mesh_of(const Part& part, int level, double radius) {
  if (part.shape == "sphere") return membrane::icosphere(level, radius);
  return membrane::revolved_mesh(meridian_of(part, radius), level);
}

/// How the mesh is turned; none: it is not.
std::optional<Eigen::Matrix3d> rotation_of(const MeshCase& mesh) {
  if (mesh.direction)
    return membrane::rotation_of_z_to(Eigen::Map<const Eigen::Vector3d>(mesh.direction->data()));
  if (mesh.euler_angles) return membrane::rotation_by_euler_angles(*mesh.euler_angles);
  return std::nullopt;
}

Eigen::Vector3d position_of(const CapsuleCase& capsule) {
  return {capsule.position[0], capsule.position[1], capsule.position[2]};
}

/// Scales a shape around the origin, turns it as the mesh of the capsule, and brings it to its place.
Eigen::Matrix3Xd in_place(const CapsuleCase& capsule, Eigen::Matrix3Xd points, double scale) {
  const auto rotation = rotation_of(capsule.mesh);
  if (rotation) points = (*rotation * points).eval();
  return (scale * points).colwise() + position_of(capsule);
}

CapsuleShape shape_from_file(const Case& the_case, std::size_t number) {
  const auto& capsule = the_case.capsules[number];
  auto surface = surface_from(the_case, mesh_file(the_case, number), !has_own_stress_free_shape(capsule));
  const double sphere_volume = 4.0 / 3.0 * std::numbers::pi * std::pow(capsule.radius, 3);
  surface.mesh.points =
      in_place(capsule, std::move(surface.mesh.points), std::cbrt(sphere_volume / surface.volume));
  return {std::move(surface.mesh), {}, std::move(surface.hash), ""};
}

CapsuleShape start_of(const Case& the_case, std::size_t number) {
  const auto& capsule = the_case.capsules[number];
  if (!capsule.mesh.file.empty()) return shape_from_file(the_case, number);
  const auto& mesh = capsule.mesh;
  if (mesh.shape == "sphere" && !rotation_of(mesh))
    return {membrane::icosphere(mesh.level, capsule.radius, position_of(capsule)), {}, "", ""};
  CapsuleShape shape{mesh_of(mesh, mesh.level, capsule.radius), {}, "", ""};
  shape.mesh.points = in_place(capsule, std::move(shape.mesh.points), 1);
  return shape;
}

/// Of a triangle more than of a node: it is where surfaces of as many nodes are found to be others.
void require_same_triangles(const Eigen::Matrix3Xi& triangles, const Eigen::Matrix3Xi& of_mesh,
                            const ShapeFile& file) {
  if (triangles.cols() != of_mesh.cols()) {
    throw InputError(fmt::format(
        "{}: {} triangles, but the mesh of the capsule has {}: {} must be a surface of the same triangles",
        file.path, triangles.cols(), of_mesh.cols(), file.key));
  }
  for (Eigen::Index t = 0; t < of_mesh.cols(); ++t) {
    if (triangles.col(t) == of_mesh.col(t)) continue;
    throw InputError(fmt::format(
        "{}: triangle {} has the nodes {}, {}, {}, in the mesh of the capsule {}, {}, {}: {} must be a "
        "surface of the same triangles",
        file.path, t, triangles(0, t), triangles(1, t), triangles(2, t), of_mesh(0, t), of_mesh(1, t),
        of_mesh(2, t), file.key));
  }
}

/// The stress-free shape of a capsule around the origin, of any size.
membrane::TriangleMesh own_stress_free_mesh(const Case& the_case, std::size_t number, CapsuleShape& shape) {
  const auto& capsule = the_case.capsules[number];
  const auto file = stress_free_file(the_case, number);
  if (file.path.empty()) return mesh_of(capsule.stress_free, capsule.mesh.level, capsule.radius);
  auto surface = surface_from(the_case, file, true);
  require_same_triangles(surface.mesh.triangles, shape.mesh.triangles, file);
  shape.stress_free_hash = std::move(surface.hash);
  return std::move(surface.mesh);
}

}  // namespace

CapsuleShape capsule_shape(const Case& the_case, std::size_t number) {
  auto shape = start_of(the_case, number);
  if (!has_own_stress_free_shape(the_case.capsules[number])) {
    shape.stress_free = shape.mesh.points;
    return shape;
  }
  auto mesh = own_stress_free_mesh(the_case, number, shape);
  const double area = membrane::surface_area(shape.mesh.points, mesh.triangles);
  const double scale = std::sqrt(area / membrane::surface_area(mesh.points, mesh.triangles));
  shape.stress_free = in_place(the_case.capsules[number], std::move(mesh.points), scale);
  return shape;
}

MembraneShapes membrane_shapes(const Case& the_case) {
  MembraneShapes shapes;
  for (std::size_t k = 0; k < the_case.capsules.size(); ++k) {
    auto shape = capsule_shape(the_case, k);
    shapes.meshes.push_back(std::move(shape.mesh));
    shapes.stress_free.push_back(std::move(shape.stress_free));
  }
  check_placement(the_case, shapes.meshes);
  return shapes;
}

std::vector<std::string> remarks_on_mesh_files(const Case& the_case) {
  std::vector<std::string> remarks;
  for (std::size_t k = 0; k < the_case.capsules.size(); ++k) {
    const auto file = file_of_stress_free(the_case, k);
    if (file.path.empty()) continue;
    const auto packet = read_shape_file(file);
    const auto step = field_number(packet, "step"), shear_time = field_number(packet, "shear_time");
    if (!(step.value_or(0) > 0)) continue;
    const auto time =
        shear_time ? fmt::format("shear time {:g}", *shear_time) : fmt::format("step {:g}", *step);
    const auto key = file.key.substr(file.key.find('.', file.key.find('.') + 1) + 1);
    remarks.push_back(
        fmt::format("capsule {}: {} {} is the deformed membrane of {} of a run, and its shape is taken as "
                    "stress-free; for the stress-free shape of that run use its file at time 0",
                    k, key, file.path, time));
  }
  return remarks;
}

}  // namespace tanktread::driver
