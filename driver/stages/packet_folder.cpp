#include "driver/stages/packet_folder.hpp"

#include <fmt/format.h>

#include "driver/stages/membrane_files.hpp"
#include "exchange/vtk_files.hpp"

namespace tanktread::driver {
namespace {

Box box_of(const System& system) {
  const auto shape = system.fluid->shape();
  return {shape.nx, shape.ny, shape.nz};
}

void check_step(const std::vector<exchange::Array>& field_data, std::int64_t step,
                const std::filesystem::path& file) {
  const auto found = step_of(field_data, file.string());
  if (found == step) return;
  throw exchange::FileError(
      fmt::format("{}: a packet of step {}, expected one of step {}", file.string(), found, step));
}

}  // namespace

std::filesystem::path packet_path(const std::filesystem::path& directory, Packet packet, std::int64_t step) {
  const auto name = name_of(packet);
  return directory / name / fmt::format("{}_{:010}.{}", name, step, is_on_grid(packet) ? "vti" : "vtu");
}

void write_packet(const std::filesystem::path& file, const System& system, Packet packet,
                  const GridVectors& vectors) {
  auto content = grid_file(vectors, array_of(packet), box_of(system), system.step + 1);
  if (packet == Packet::grid_velocity) {
    std::vector<double> density(static_cast<std::size_t>(system.fluid->shape().size()));
    // The same numbers on the nodes that are touched: both come from the same populations and forces.
    system.fluid->moments(density, content.point_data[0].values);
  }
  exchange::write_grid(file, content);
}

void write_packet(const std::filesystem::path& file, const System& system, Packet packet,
                  const NodeVectors& vectors) {
  auto surfaces = surfaces_of(system.membranes);
  if (packet == Packet::positions) surfaces.positions = vectors;
  auto content = surface_file(surfaces, system.step + 1);
  if (packet != Packet::positions) add_vectors(content, array_of(packet), vectors);
  exchange::write_surface(file, content);
}

GridVectors read_grid_packet(const std::filesystem::path& file, Packet packet, const Box& box,
                             std::int64_t step) {
  const auto content = exchange::read_grid(file);
  check_step(content.field_data, step, file);
  return grid_vectors_of(content, array_of(packet), box, file.string());
}

NodeVectors read_node_packet(const std::filesystem::path& file, Packet packet, const NodeVectors& like,
                             std::int64_t step) {
  const auto content = exchange::read_surface(file);
  check_step(content.field_data, step, file);
  auto surfaces = surfaces_of(content, file.string());
  check_sizes(surfaces.positions, like, file.string());
  if (packet == Packet::positions) return std::move(surfaces.positions);
  return vectors_of(content, array_of(packet), surfaces, file.string());
}

}  // namespace tanktread::driver
