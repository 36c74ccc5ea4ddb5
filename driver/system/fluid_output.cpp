#include "driver/system/fluid_output.hpp"

#include <cstdint>
#include <span>

#include "driver/packets/fluid_files.hpp"
#include "driver/packets/packet_files.hpp"
#include "driver/program/file_ending.hpp"
#include "driver/system/fluid_on_ranks.hpp"
#include "driver/system/fluid_pieces.hpp"
#include "driver/system/state_from_pieces.hpp"
#include "exchange/vtk_files.hpp"

namespace tanktread::driver {
namespace {

namespace fs = std::filesystem;

}  // namespace

bool has_large_box(const Case& the_case) {
  double n_nodes = 1;
  for (const int n : the_case.flow.box) n_nodes *= n;
  return n_nodes > the_case.output.whole_file_nodes;
}

bool writes_pieces(const System& system, const Case& the_case) {
  return has_large_box(the_case) && dynamic_cast<const FluidOnRanks*>(system.fluid.get()) == nullptr;
}

void write_flow(const System& system, const Case& the_case, const fs::path& file) {
  const auto& range = the_case.output.fluid_box;
  const auto inside = system.inside ? system.inside->marks() : std::span<const std::int32_t>();
  if (writes_pieces(system, the_case)) {
    return write_as_one_piece(*system.fluid, inside,
                              {with_ending(file, ".pvti"), range.value_or(whole_range(the_case.flow.box)),
                               false, system.step, system.shear_time()});
  }
  exchange::write_grid(with_ending(file, ".vti"),
                       flow_file(*system.fluid, range, system.step, system.shear_time(), inside));
}

void write_fluid_state(const fluid::Fluid& fluid, bool in_pieces, const fs::path& file) {
  const auto shape = fluid.shape();
  if (in_pieces) {
    return write_as_one_piece(fluid, {},
                              {with_ending(file, ".pvti"), whole_range({shape.nx, shape.ny, shape.nz}), true,
                               fluid.state_shape().step, 0});
  }
  exchange::write_grid(with_ending(file, ".vti"), state_file(fluid.state(), shape));
}

void restore_fluid(fluid::Fluid& fluid, const SavedState& state) {
  if (state.fluid_pieces.empty()) return fluid.restore(state.fluid);
  if (auto* on_ranks = dynamic_cast<FluidOnRanks*>(&fluid))
    return on_ranks->restore_pieces(state.fluid_pieces);
  restore_from_pieces(fluid, state.fluid_pieces);
}

}  // namespace tanktread::driver
