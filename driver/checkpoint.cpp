#include "driver/checkpoint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "driver/stages/fluid_files.hpp"
#include "driver/stages/packet_files.hpp"
#include "driver/stages/phases.hpp"
#include "driver/surface_mesh.hpp"
#include "exchange/vtk_files.hpp"

namespace tanktread::driver {
namespace {

exchange::SurfacePacket to_packet(const membrane::Membrane& membrane, std::int64_t step) {
  auto packet = surface_packet(membrane::TriangleMesh{membrane.positions(), membrane.reference().triangles});
  packet.point_data = {{"reference_position", 3, to_values(membrane.reference().points)}};
  packet.field_data = {{"step", 1, {static_cast<double>(step)}},
                       {"schema_version", 1, {schema_version}},
                       {"history", 1, membrane.history()}};
  return packet;
}

void read_capsule(const std::filesystem::path& file, Checkpoint& checkpoint) {
  const auto packet = exchange::read_surface(file);
  check_schema_version(packet.field_data, file.string());
  auto reference = to_mesh(packet);
  checkpoint.positions.push_back(reference.points);
  reference.points =
      to_matrix(exchange::find_array(packet.point_data, "reference_position", file.string()).values);
  checkpoint.references.push_back(std::move(reference));
  checkpoint.histories.push_back(exchange::find_array(packet.field_data, "history", file.string()).values);
}

std::filesystem::path capsule_file(const std::filesystem::path& folder, std::size_t k) {
  return folder / fmt::format("capsule_{}.vtu", k);
}

}  // namespace

void write_checkpoint(const System& system, const std::filesystem::path& directory) {
  const auto place = directory / "checkpoints";
  const auto folder = place / fmt::format("step_{:010}", system.step);
  if (std::filesystem::exists(folder))
    return;  // the same state: a run is the same however often it is resumed
  const auto temporary = place / fmt::format(".step_{:010}.tmp", system.step);
  std::filesystem::create_directories(temporary);
  exchange::write_grid(temporary / "fluid.vti", state_file(system.fluid->state(), system.fluid->shape()));
  for (std::size_t k = 0; k < system.membranes.size(); ++k) {
    exchange::write_surface(capsule_file(temporary, k), to_packet(system.membranes[k], system.step));
  }
  std::filesystem::rename(temporary, folder);
  auto folders = checkpoint_folders(directory);
  while (folders.size() > 2) {
    std::filesystem::remove_all(folders.front());
    folders.erase(folders.begin());
  }
}

std::vector<std::filesystem::path> checkpoint_folders(const std::filesystem::path& directory) {
  std::vector<std::filesystem::path> folders;
  if (!std::filesystem::is_directory(directory / "checkpoints")) return folders;
  for (const auto& entry : std::filesystem::directory_iterator(directory / "checkpoints")) {
    if (entry.path().filename().string().starts_with("step_")) folders.push_back(entry.path());
  }
  std::sort(folders.begin(), folders.end());
  return folders;
}

namespace {

Checkpoint read_checkpoint(const std::filesystem::path& folder) {
  Checkpoint checkpoint;
  checkpoint.folder = folder;
  const auto fluid = folder / "fluid.vti";
  checkpoint.fluid = state_of(exchange::read_grid(fluid), fluid.string());
  checkpoint.step = checkpoint.fluid.step;
  for (std::size_t k = 0; std::filesystem::exists(capsule_file(folder, k)); ++k) {
    read_capsule(capsule_file(folder, k), checkpoint);
  }
  return checkpoint;
}

}  // namespace

Checkpoint read_last_checkpoint(const std::filesystem::path& directory) {
  const auto folders = checkpoint_folders(directory);
  if (folders.empty()) {
    throw InputError(
        fmt::format("{}: no checkpoint to resume from (looked for checkpoints/step_*); start the case anew",
                    directory.string()));
  }
  try {
    return read_checkpoint(folders.back());
  } catch (const exchange::FileError& error) {
    const bool has_other = folders.size() > 1;
    throw InputError(fmt::format("{}\n{}: the checkpoint cannot be used; {}", error.what(),
                                 folders.back().string(),
                                 has_other ? "remove it to go on from " + folders[folders.size() - 2].string()
                                           : std::string("there is no other, start the case anew")));
  }
}

void restore(System& system, const Checkpoint& checkpoint) {
  if (checkpoint.positions.size() != system.membranes.size()) {
    throw InputError(fmt::format("{}: {} capsules, the case has {}", checkpoint.folder.string(),
                                 checkpoint.positions.size(), system.membranes.size()));
  }
  system.step = checkpoint.step;
  try {
    system.fluid->restore(checkpoint.fluid);
    for (std::size_t k = 0; k < system.membranes.size(); ++k) {
      system.membranes[k].set_positions(checkpoint.positions[k]);
      system.membranes[k].restore_history(checkpoint.histories[k]);
    }
  } catch (const std::invalid_argument& error) {
    throw InputError(fmt::format("{}: does not fit the case: {}", checkpoint.folder.string(), error.what()));
  }
  build_stencils(*system.coupler, checkpoint.positions);
}

}  // namespace tanktread::driver
