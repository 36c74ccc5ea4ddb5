#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <optional>

#include "driver/packets/field_number.hpp"
#include "driver/packets/surface_mesh.hpp"
#include "driver/system/components.hpp"
#include "driver/system/placement.hpp"
#include "driver/units/laws.hpp"
#include "exchange/vtk_files.hpp"

namespace tanktread::driver {
namespace {

/// The file that a case was made with may have been changed since. @throws InputError
void check_hash(const Case& the_case, std::size_t number, const std::string& hash) {
  const auto& mesh = the_case.capsules[number].mesh;
  if (mesh.file_hash.empty() || mesh.file_hash == hash) return;
  throw InputError(
      fmt::format("{0}: capsule.{1}.mesh.file_hash = \"{2}\", but {3} has the hash \"{4}\": it is not the "
                  "surface that the "
                  "case was made with; put that file back, or say that this one is meant: with --set "
                  "capsule.{1}.mesh.file_hash={4}, or without the key",
                  the_case.file.string(), number, mesh.file_hash, mesh.file, hash));
}

exchange::SurfacePacket read_mesh_file(const CapsuleCase& capsule) {
  try {
    return exchange::read_surface(capsule.mesh.file, true);
  } catch (const exchange::FileError& error) {
    throw InputError(error.what());
  }
}

/// A state says itself that its points are not the stress-free shape, so taking them for it is a mistake;
/// other deformed shapes may be meant (remarks_on_mesh_files).
void require_no_deformed_state(const exchange::SurfacePacket& packet, const std::filesystem::path& file) {
  const auto* reference = exchange::find_optional_array(packet.point_data, "reference_position");
  if (reference == nullptr || reference->values == packet.points) return;
  throw InputError(
      fmt::format("{}: is the state of a deformed membrane, whose stress-free shape is its array "
                  "reference_position, not its points; name the mesh that the run was made with, or "
                  "membrane_0000000000.vtu of its output",
                  file.string()));
}

ReferenceMesh mesh_from_file(const Case& the_case, std::size_t number) {
  const auto& capsule = the_case.capsules[number];
  const auto file = std::filesystem::path(capsule.mesh.file);
  const auto packet = read_mesh_file(capsule);
  ReferenceMesh result{to_mesh(packet), geometry_hash(packet)};
  auto& mesh = result.mesh;
  check_hash(the_case, number, result.file_hash);
  require_no_deformed_state(packet, file);
  const auto report = inspected(mesh, file.string());
  require_no_defects(report, file.string());
  const double sphere_volume = 4.0 / 3.0 * std::numbers::pi * std::pow(capsule.radius, 3);
  const double scale = std::cbrt(sphere_volume / report.volume);
  const Eigen::Vector3d position(capsule.position[0], capsule.position[1], capsule.position[2]);
  mesh.points = (scale * (mesh.points.colwise() - report.centre)).colwise() + position;
  return result;
}

}  // namespace

ReferenceMesh reference_mesh(const Case& the_case, std::size_t number) {
  const auto& capsule = the_case.capsules[number];
  if (!capsule.mesh.file.empty()) return mesh_from_file(the_case, number);
  return {membrane::icosphere(capsule.mesh.level, capsule.radius,
                              {capsule.position[0], capsule.position[1], capsule.position[2]}),
          ""};
}

std::vector<membrane::TriangleMesh> reference_meshes(const Case& the_case) {
  std::vector<membrane::TriangleMesh> meshes;
  for (std::size_t k = 0; k < the_case.capsules.size(); ++k)
    meshes.push_back(reference_mesh(the_case, k).mesh);
  check_placement(the_case, meshes);
  return meshes;
}

std::vector<std::string> remarks_on_mesh_files(const Case& the_case) {
  std::vector<std::string> remarks;
  for (std::size_t k = 0; k < the_case.capsules.size(); ++k) {
    const auto& capsule = the_case.capsules[k];
    if (is_sphere(capsule)) continue;
    const auto packet = read_mesh_file(capsule);
    const auto step = field_number(packet, "step"), shear_time = field_number(packet, "shear_time");
    if (!(step.value_or(0) > 0)) continue;
    const auto time =
        shear_time ? fmt::format("shear time {:g}", *shear_time) : fmt::format("step {:g}", *step);
    remarks.push_back(fmt::format(
        "capsule {}: mesh.file {} is the deformed membrane of {} of a run, and its shape is taken as "
        "stress-free; for the stress-free shape of that run use its file at time 0",
        k, capsule.mesh.file, time));
  }
  return remarks;
}

std::vector<CapsuleMembrane> make_membranes(const Case& the_case, const Parameters& parameters,
                                            const std::vector<membrane::TriangleMesh>& meshes) {
  if (meshes.size() != the_case.capsules.size()) {
    throw InputError(
        fmt::format("{}: {} capsules, but there are meshes of {}: the state and the case do not fit",
                    the_case.file.string(), the_case.capsules.size(), meshes.size()));
  }
  std::vector<CapsuleMembrane> membranes;
  for (std::size_t k = 0; k < meshes.size(); ++k) {
    const bool has_program = !the_case.capsules[k].membrane.command.empty();
    membrane::Membrane membrane(meshes[k], elastic_law(the_case.capsules[k].membrane, parameters.capsules[k]),
                                has_program ? nullptr : viscous_law(parameters.capsules[k]),
                                the_case.run.threads);
    if (!has_program)
      membrane.set_energy_terms(energy_terms(the_case.capsules[k].membrane, parameters.capsules[k], meshes[k],
                                             the_case.run.threads));
    membranes.emplace_back(
        std::move(membrane),
        has_program ? std::make_unique<OutsideMembrane>(the_case, parameters, k) : nullptr,
        has_program ? nullptr : implicit_viscosity(parameters.capsules[k], meshes[k], the_case.run.threads));
  }
  return membranes;
}

}  // namespace tanktread::driver
