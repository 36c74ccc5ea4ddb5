#include "driver/packets/packet_folder.hpp"

#include <fmt/format.h>

#include "exchange/vtk_files.hpp"

namespace tanktread::driver {
namespace {

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

GridVectors read_grid_packet(const std::filesystem::path& file, Packet packet, const Box& box,
                             std::int64_t step) {
  const auto content = exchange::read_grid(file);
  check_step(content.field_data, step, file);
  return grid_vectors_of(content, array_of(packet), box, file.string());
}

GridMarks read_marks_packet(const std::filesystem::path& file, std::size_t n_capsules, const Box& box,
                            std::int64_t step) {
  const auto content = exchange::read_grid(file);
  check_step(content.field_data, step, file);
  return grid_marks_of(content, n_capsules, box, file.string());
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
