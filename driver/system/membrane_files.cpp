#include "driver/system/membrane_files.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "driver/packets/packet_files.hpp"
#include "driver/packets/saved_state.hpp"
#include "driver/system/phases.hpp"
#include "driver/units/laws.hpp"
#include "exchange/vtk_files.hpp"

namespace tanktread::driver {
namespace {

using exchange::Array;

void append(std::vector<double>& values, const double* data, Eigen::Index size) {
  values.insert(values.end(), data, data + size);
}

void add_program_arrays(exchange::SurfacePacket& file, const std::vector<Array>& arrays,
                        const std::string& prefix) {
  for (const auto& array : arrays)
    file.field_data.push_back({prefix + array.name, array.components, array.values});
}

NodeVectors elastic_forces(const std::vector<CapsuleMembrane>& membranes) {
  NodeVectors forces;
  for (const auto& membrane : membranes) forces.push_back(membrane.elastic_forces());
  return forces;
}

bool any_starts_elsewhere(const std::vector<CapsuleMembrane>& membranes) {
  return std::ranges::any_of(membranes, [](const CapsuleMembrane& membrane) {
    return membrane.start() != membrane.reference().points;
  });
}

/// @throws exchange::FileError if the shapes are not the same, but for rounding
void check_shape(const Eigen::Matrix3Xd& in_file, const Eigen::Matrix3Xd& of_case, const char* which,
                 std::size_t capsule, const std::string& name) {
  // Another processor may round the coordinates otherwise, by some 1e-13 in a box of 1000; a change that a
  // user makes is larger.
  constexpr double rounding = 1e-9;
  const double largest = (in_file - of_case).cwiseAbs().maxCoeff();
  if (largest <= rounding) return;
  throw exchange::FileError(
      fmt::format("{0}: the {3} shape of capsule {1} lies up to {2:.3g} grid steps from that of "
                  "the case; give the "
                  "case that made the file: capsule.{1}.radius, position, mesh or stress_free is another",
                  name, capsule, largest, which));
}

/// Where no capsule has a load there is no array.
void add_loads(exchange::SurfacePacket& file, const std::vector<CapsuleMembrane>& membranes,
               std::int64_t step) {
  if (std::ranges::none_of(membranes, &CapsuleMembrane::has_load)) return;
  NodeVectors loads;
  for (const auto& membrane : membranes) loads.push_back(membrane.load_at(step));
  add_vectors(file, "load_force", loads);
}

NodeVectors term_forces(const std::vector<CapsuleMembrane>& membranes, const std::string& term) {
  NodeVectors forces;
  for (const auto& membrane : membranes) forces.push_back(membrane.term_forces(term));
  return forces;
}

void add_element_fields(exchange::SurfacePacket& file, const std::vector<CapsuleMembrane>& membranes) {
  Array stretches{"principal_stretches", 2, {}}, stress{"stress", 9, {}};
  Array viscous_stress{"viscous_stress", 9, {}}, area_ratio{"area_ratio", 1, {}};
  for (const auto& membrane : membranes) {
    const auto fields = membrane.element_fields();
    append(stretches.values, fields.principal_stretches.data(), fields.principal_stretches.size());
    append(stress.values, fields.stress.data(), fields.stress.size());
    append(viscous_stress.values, fields.viscous_stress.data(), fields.viscous_stress.size());
    append(area_ratio.values, fields.area_ratio.data(), fields.area_ratio.size());
  }
  for (auto* array : {&stretches, &stress, &viscous_stress, &area_ratio})
    file.cell_data.push_back(std::move(*array));
}

}  // namespace

Surfaces surfaces_of(const std::vector<CapsuleMembrane>& membranes) {
  Surfaces surfaces;
  surfaces.positions = positions_of(membranes);
  for (const auto& membrane : membranes) surfaces.triangles.push_back(membrane.reference().triangles);
  return surfaces;
}

exchange::SurfacePacket membrane_file(const std::vector<CapsuleMembrane>& membranes,
                                      const NodeVectors& velocity, const NodeVectors& force,
                                      std::int64_t step, double shear_time) {
  auto file = surface_file(surfaces_of(membranes), step);
  add_vectors(file, "velocity", velocity);
  add_vectors(file, "elastic_force", elastic_forces(membranes));
  for (const auto& term : term_names(membranes))
    add_vectors(file, name_in_files(term) + "_force", term_forces(membranes, term));
  add_vectors(file, "total_force", force);
  add_loads(file, membranes, step);
  add_element_fields(file, membranes);
  file.field_data.push_back({"shear_time", 1, {shear_time}});
  return file;
}

void add_state(exchange::SurfacePacket& file, const std::vector<CapsuleMembrane>& membranes) {
  NodeVectors references;
  for (const auto& membrane : membranes) references.push_back(membrane.reference().points);
  add_vectors(file, reference_array, references);
  // A file of before there were two shapes is one of equal ones.
  if (any_starts_elsewhere(membranes)) {
    NodeVectors starts;
    for (const auto& membrane : membranes) starts.push_back(membrane.start());
    add_vectors(file, start_array, starts);
  }
  for (std::size_t k = 0; k < membranes.size(); ++k) {
    auto state = membranes[k].state();
    file.field_data.push_back({history_name(k), 1, std::move(state.history)});
    add_program_arrays(file, state.program.point_data, program_prefix(k, "point"));
    add_program_arrays(file, state.program.cell_data, program_prefix(k, "cell"));
  }
}

void restore_membranes(std::vector<CapsuleMembrane>& membranes, const exchange::SurfacePacket& file,
                       const std::string& name) {
  check_schema_version(file.field_data, name);
  for (std::size_t k = 0; k < membranes.size(); ++k) {
    try {
      membranes[k].restore(membrane_state_of(file, k, name));
    } catch (const std::invalid_argument& error) {
      throw exchange::FileError(fmt::format("{}: {} does not fit the case's membrane {}: {}", name,
                                            history_name(k), k, error.what()));
    }
  }
}

void check_references(const exchange::SurfacePacket& file, const std::vector<CapsuleMembrane>& membranes,
                      const std::string& name) {
  if (exchange::find_optional_array(file.point_data, reference_array) == nullptr) return;
  const auto shapes = shapes_of(file, surfaces_of(file, name), name);
  for (std::size_t k = 0; k < membranes.size(); ++k) {
    check_shape(shapes.stress_free[k], membranes[k].reference().points, "stress-free", k, name);
    check_shape(shapes.meshes[k].points, membranes[k].start(), "first", k, name);
  }
}

void check_surfaces(const Surfaces& surfaces, const std::vector<CapsuleMembrane>& membranes,
                    const std::string& name) {
  if (surfaces.positions.size() != membranes.size()) {
    throw exchange::FileError(
        fmt::format("{}: {} capsules, the case has {}", name, surfaces.positions.size(), membranes.size()));
  }
  for (std::size_t k = 0; k < membranes.size(); ++k) {
    const auto& reference = membranes[k].reference();
    if (surfaces.positions[k].cols() == reference.points.cols() &&
        surfaces.triangles[k] == reference.triangles)
      continue;
    throw exchange::FileError(
        fmt::format("{}: capsule {} has {} nodes and {} triangles, that of the case {} and {}, or they are "
                    "connected otherwise; use a "
                    "file of the same mesh",
                    name, k, surfaces.positions[k].cols(), surfaces.triangles[k].cols(),
                    reference.points.cols(), reference.triangles.cols()));
  }
}

}  // namespace tanktread::driver
