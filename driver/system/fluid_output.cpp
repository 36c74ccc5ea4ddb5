#include "driver/system/fluid_output.hpp"

#include <cstdint>
#include <utility>

#include "driver/packets/fluid_files.hpp"
#include "driver/packets/packet_files.hpp"
#include "driver/system/fluid_on_ranks.hpp"
#include "driver/system/fluid_pieces.hpp"
#include "driver/system/system_on_ranks.hpp"
#include "exchange/vtk_files.hpp"

namespace tanktread::driver {
namespace {

namespace fs = std::filesystem;

fs::path with_ending(fs::path file, const char* ending) {
  return file += ending;
}

Ranges3 whole_range(const fluid::GridShape& shape) {
  return {{{0, shape.nx - 1}, {0, shape.ny - 1}, {0, shape.nz - 1}}};
}

/// All of a grid as the one piece of an index.
void write_one_piece(const fs::path& file, const exchange::GridPacket& packet) {
  const auto folder = folder_of_pieces(file);
  fs::create_directories(folder);
  const exchange::GridBlock whole{{0, 0, 0}, packet.nodes};
  exchange::GridIndex index{whole, packet.origin, packet.spacing, {}, packet.field_data, {}};
  for (const auto& array : packet.point_data) index.point_data.push_back({array.name, array.components});
  index.pieces = {{(folder.filename() / "0.vti").string(), whole}};
  exchange::write_grid(folder / "0.vti", packet);
  exchange::write_grid_index(file, index);
}

void write_packet(const fs::path& file, bool in_pieces, const exchange::GridPacket& packet) {
  if (in_pieces) return write_one_piece(with_ending(file, ".pvti"), packet);
  exchange::write_grid(with_ending(file, ".vti"), packet);
}

}  // namespace

bool writes_pieces(const System& system, const Case& the_case) {
  const bool is_large = system.fluid->shape().size() > the_case.output.whole_file_nodes;
  const bool is_shared = dynamic_cast<const FluidOnRanks*>(system.fluid.get()) != nullptr;
  return is_large && (system.on_ranks || !is_shared);
}

void write_flow(const System& system, const Case& the_case, const fs::path& file) {
  const bool in_pieces = writes_pieces(system, the_case);
  const auto& range = the_case.output.fluid_box;
  if (in_pieces && system.on_ranks) {
    return system.on_ranks->write_pieces({with_ending(file, ".pvti"),
                                          range.value_or(whole_range(system.fluid->shape())), false,
                                          system.step, system.shear_time()});
  }
  write_packet(file, in_pieces,
               flow_file(*system.fluid, range, system.step, system.shear_time(),
                         system.inside ? system.inside->marks() : std::span<const std::int32_t>()));
}

void write_fluid_state(const System& system, bool in_pieces, const fs::path& file) {
  if (in_pieces && system.on_ranks) {
    return system.on_ranks->write_pieces({with_ending(file, ".pvti"), whole_range(system.fluid->shape()),
                                          true, system.step, system.shear_time()});
  }
  write_packet(file, in_pieces, state_file(system.fluid->state(), system.fluid->shape()));
}

void restore_fluid(System& system, const SavedState& state) {
  if (state.fluid_pieces.empty()) return system.fluid->restore(state.fluid);
  if (auto* on_ranks = dynamic_cast<FluidOnRanks*>(system.fluid.get()))
    return on_ranks->restore_pieces(state.fluid_pieces);
  const auto shape = system.fluid->shape();
  const ranks::Triple box = {shape.nx, shape.ny, shape.nz};
  system.fluid->restore(read_state_block(state.fluid_pieces, box, {{0, 0, 0}, box}));
}

}  // namespace tanktread::driver
