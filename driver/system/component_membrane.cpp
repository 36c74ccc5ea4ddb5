#include <fmt/format.h>

#include <cmath>
#include <numbers>

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

ReferenceMesh mesh_from_file(const Case& the_case, std::size_t number) {
  const auto& capsule = the_case.capsules[number];
  const auto file = std::filesystem::path(capsule.mesh.file);
  ReferenceMesh result;
  auto& mesh = result.mesh;
  try {
    const auto packet = exchange::read_surface(file, true);
    result.file_hash = geometry_hash(packet);
    mesh = to_mesh(packet);
  } catch (const exchange::FileError& error) {
    throw InputError(error.what());
  }
  check_hash(the_case, number, result.file_hash);
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
    membranes.emplace_back(
        std::move(membrane),
        has_program ? std::make_unique<OutsideMembrane>(the_case, parameters, k) : nullptr);
  }
  return membranes;
}

}  // namespace tanktread::driver
