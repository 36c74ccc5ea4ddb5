#include "driver/system/fluid_output.hpp"

#include <cstdint>
#include <span>

#include "driver/packets/fluid_files.hpp"
#include "driver/packets/packet_files.hpp"
#include "driver/program/file_ending.hpp"
#include "driver/system/fluid_on_ranks.hpp"
#include "driver/system/fluid_pieces.hpp"
#include "exchange/vtk_files.hpp"

namespace tanktread::driver {
namespace {

namespace fs = std::filesystem;

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

bool has_large_box(const Case& the_case) {
  double n_nodes = 1;
  for (const int n : the_case.flow.box) n_nodes *= n;
  return n_nodes > the_case.output.whole_file_nodes;
}

void write_flow(const System& system, const Case& the_case, const fs::path& file) {
  write_packet(file, has_large_box(the_case),
               flow_file(*system.fluid, the_case.output.fluid_box, system.step, system.shear_time(),
                         system.inside ? system.inside->marks() : std::span<const std::int32_t>()));
}

void write_fluid_state(const fluid::Fluid& fluid, bool in_pieces, const fs::path& file) {
  write_packet(file, in_pieces, state_file(fluid.state(), fluid.shape()));
}

void restore_fluid(fluid::Fluid& fluid, const SavedState& state) {
  if (state.fluid_pieces.empty()) return fluid.restore(state.fluid);
  if (auto* on_ranks = dynamic_cast<FluidOnRanks*>(&fluid))
    return on_ranks->restore_pieces(state.fluid_pieces);
  const auto shape = fluid.shape();
  const ranks::Triple box = {shape.nx, shape.ny, shape.nz};
  fluid.restore(read_state_block(state.fluid_pieces, box, {{0, 0, 0}, box}));
}

}  // namespace tanktread::driver
