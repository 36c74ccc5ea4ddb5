#include "driver/stages/file_passage.hpp"

#include <numeric>

#include "driver/packets/packet_folder.hpp"
#include "driver/system/membrane_files.hpp"
#include "driver/system/state_folder.hpp"

namespace tanktread::driver {
namespace {

Box box_of(const System& system) {
  const auto shape = system.fluid->shape();
  return {shape.nx, shape.ny, shape.nz};
}

/// Writes a packet of the step that the system is at work on. What lives on capsules has their present
/// positions as points.
void write_packet(const std::filesystem::path& file, const System& system, Packet packet,
                  const GridVectors& vectors) {
  auto content = grid_file(vectors, array_of(packet), box_of(system), system.step + 1);
  if (packet == Packet::grid_velocity) {
    std::vector<double> density(static_cast<std::size_t>(system.fluid->shape().size()));
    // The same numbers on the nodes that are touched: both come from the same populations and forces.
    system.fluid->moments(density, content.point_data[0].values);
  } else if (packet == Packet::free_velocity) {
    std::vector<std::int64_t> all(static_cast<std::size_t>(system.fluid->shape().size()));
    std::iota(all.begin(), all.end(), 0);
    system.fluid->free_velocity(all, content.point_data[0].values, content.point_data[1].values);
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

void write_packet(const std::filesystem::path& file, const System& system, Packet, const GridMarks& marks) {
  exchange::write_grid(file, marks_file(marks, system.inside->marks(), box_of(system), system.step + 1));
}

}  // namespace

FilePassage::FilePassage(std::filesystem::path directory) : directory_(std::move(directory)) {
  std::filesystem::create_directories(directory_);
}

void FilePassage::pass(const System& system, Packet packet, GridVectors& vectors) {
  const auto file = directory_ / (name_of(packet) + ".vti");
  write_packet(file, system, packet, vectors);
  vectors = read_grid_packet(file, packet, box_of(system), system.step + 1);
}

void FilePassage::pass(const System& system, Packet packet, NodeVectors& vectors) {
  const auto file = directory_ / (name_of(packet) + ".vtu");
  write_packet(file, system, packet, vectors);
  vectors = read_node_packet(file, packet, vectors, system.step + 1);
}

void FilePassage::pass(const System& system, Packet packet, GridMarks& marks) {
  const auto file = directory_ / (name_of(packet) + ".vti");
  write_packet(file, system, packet, marks);
  marks = read_marks_packet(file, system.membranes.size(), box_of(system), system.step + 1);
}

Recorder::Recorder(std::filesystem::path directory, RecordedSteps steps, const Case& the_case,
                   bool has_implicit)
    : directory_(std::move(directory)), steps_(steps), case_(the_case) {
  for (const auto packet : all_packets) {
    if (is_of_implicit(packet) && !has_implicit) continue;
    if (is_of_contrast(packet) && !has_contrast(the_case)) continue;
    std::filesystem::create_directories(directory_ / name_of(packet));
    exchange::write_series(directory_ / (name_of(packet) + ".pvd"), {});
  }
}

template <class Vectors>
void Recorder::record(const System& system, Packet packet, const Vectors& vectors) {
  if (system.step < steps_.from || system.step >= steps_.to) return;
  const auto file = packet_path(directory_, packet, system.step + 1);
  write_packet(file, system, packet, vectors);
  const auto series = directory_ / (name_of(packet) + ".pvd");
  exchange::append_to_series(series, {static_cast<double>(system.step + 1) * system.shear_rate,
                                      file.lexically_relative(directory_).string()});
}

void Recorder::pass(const System& system, Packet packet, GridVectors& vectors) {
  // The first packet of a step: the system still stands at its beginning.
  if (packet == Packet::grid_velocity && system.step == steps_.from) {
    write_state(directory_ / "begin", system, case_);
  }
  record(system, packet, vectors);
}

void Recorder::pass(const System& system, Packet packet, NodeVectors& vectors) {
  record(system, packet, vectors);
}

void Recorder::pass(const System& system, Packet packet, GridMarks& marks) {
  record(system, packet, marks);
}

void Recorder::step_done(const System& system) {
  if (system.step == steps_.to) write_state(directory_ / "end", system, case_);
}

void Recorder::stopped(const System& system) {
  if (system.step > steps_.from && system.step < steps_.to) write_state(directory_ / "end", system, case_);
}

}  // namespace tanktread::driver
