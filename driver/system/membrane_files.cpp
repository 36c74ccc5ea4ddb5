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

/// A vector on the nodes of each membrane.
template <class OfMembrane>
NodeVectors vectors_of_each(std::span<const CapsuleMembrane> membranes, const OfMembrane& of_membrane) {
  NodeVectors vectors;
  for (const auto& membrane : membranes) vectors.push_back(of_membrane(membrane));
  return vectors;
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

void add_element_fields(exchange::SurfacePacket& file, std::span<const CapsuleMembrane> membranes) {
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

Surfaces surfaces_of(std::span<const CapsuleMembrane> membranes) {
  Surfaces surfaces;
  for (const auto& membrane : membranes) {
    surfaces.positions.push_back(membrane.positions());
    surfaces.triangles.push_back(membrane.reference().triangles);
  }
  return surfaces;
}

MembraneArrays arrays_of(std::span<const CapsuleMembrane> membranes) {
  return {term_names(membranes), std::ranges::any_of(membranes, &CapsuleMembrane::has_load),
          std::ranges::any_of(membranes, [](const CapsuleMembrane& membrane) {
            return membrane.start() != membrane.reference().points;
          })};
}

exchange::SurfacePacket membrane_file(const CapsulesNow& capsules, const MembraneArrays& arrays) {
  const auto& membranes = capsules.membranes;
  const auto of_each = [&](const auto& of_membrane) { return vectors_of_each(membranes, of_membrane); };
  auto file = surface_file(surfaces_of(membranes), capsules.step, capsules.number(0));
  add_vectors(file, "velocity", capsules.velocity);
  add_vectors(file, "elastic_force",
              of_each([](const CapsuleMembrane& membrane) { return membrane.elastic_forces(); }));
  for (const auto& term : arrays.terms) {
    add_vectors(file, name_in_files(term) + "_force",
                of_each([&](const CapsuleMembrane& membrane) { return membrane.term_forces(term); }));
  }
  add_vectors(file, "total_force", capsules.force);
  if (arrays.has_loads) {
    add_vectors(file, "load_force",
                of_each([&](const CapsuleMembrane& membrane) { return membrane.load_at(capsules.step); }));
  }
  add_element_fields(file, membranes);
  file.field_data.push_back({"shear_time", 1, {capsules.shear_time()}});
  return file;
}

exchange::SurfacePacket membrane_file(const std::vector<CapsuleMembrane>& membranes,
                                      const NodeVectors& velocity, const NodeVectors& force,
                                      std::int64_t step, double shear_time) {
  auto file = membrane_file(CapsulesNow{membranes, velocity, force, {}, 0, step, 0}, arrays_of(membranes));
  file.field_data.back().values = {shear_time};
  return file;
}

void add_state(exchange::SurfacePacket& file, const CapsulesNow& capsules, const MembraneArrays& arrays) {
  const auto& membranes = capsules.membranes;
  add_vectors(file, reference_array, vectors_of_each(membranes, [](const CapsuleMembrane& membrane) {
                return membrane.reference().points;
              }));
  // A file of before there were two shapes is one of equal ones.
  if (arrays.starts_elsewhere) {
    add_vectors(file, start_array,
                vectors_of_each(membranes, [](const CapsuleMembrane& membrane) { return membrane.start(); }));
  }
  for (std::size_t k = 0; k < membranes.size(); ++k) {
    const auto number = capsules.number(k);
    auto state = membranes[k].state();
    file.field_data.push_back({history_name(number), 1, std::move(state.history)});
    add_program_arrays(file, state.program.point_data, program_prefix(number, "point"));
    add_program_arrays(file, state.program.cell_data, program_prefix(number, "cell"));
  }
}

void add_state(exchange::SurfacePacket& file, const std::vector<CapsuleMembrane>& membranes) {
  add_state(file, CapsulesNow{membranes, {}, {}, {}, 0, 0, 0}, arrays_of(membranes));
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
