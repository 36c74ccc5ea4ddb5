#include "driver/system/fluid_pieces.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <stdexcept>
#include <utility>

#include "driver/packets/packet_files.hpp"
#include "driver/packets/saved_state.hpp"
#include "driver/system/region_halo.hpp"
#include "exchange/vtk_files.hpp"

namespace tanktread::driver {
namespace {

using exchange::Array;
using exchange::GridBlock;

/// The nodes of a range that a rank's piece is to have: its own, and the layer beyond. Without any: 0 nodes.
coupler::GridPart region_of(const ranks::Division& division, int rank, const Ranges3& range) {
  const auto block = division.block(rank);
  coupler::GridPart region{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const int first = std::max(block.begin[axis], range[axis][0]);
    const int last = std::min(block.begin[axis] + block.n[axis] - 1, range[axis][1]);
    if (last < first) return {};
    region.begin[axis] = first;
    region.nodes[axis] = last - first + 1 + (last < range[axis][1] ? 1 : 0);
  }
  return region;
}

/// The piece of a rank, by the numbers that the file gives to nodes: 0 is the first of the range. None if it
/// has no cells of the range; its last nodes are its neighbour's layer then.
std::optional<GridBlock> piece_of(const ranks::Division& division, int rank, const Ranges3& range) {
  const auto region = region_of(division, rank, range);
  GridBlock piece;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const bool is_sheet = range[axis][0] == range[axis][1];
    if (region.nodes[axis] < (is_sheet ? 1 : 2)) return std::nullopt;
    piece.begin[axis] = region.begin[axis] - range[axis][0];
    piece.nodes[axis] = region.nodes[axis];
  }
  return piece;
}

/// Numbers of a rank's block, brought to the nodes of its piece.
class PieceNodes {
 public:
  /// Together.
  PieceNodes(const ranks::World& world, const ranks::Division& division, const Ranges3& range)
      : block_(division.block(world.rank())),
        region_(region_of(division, world.rank(), range)),
        halo_(world, division, region_) {
    // Neighbours ask for the first layers of a block, and it asks for those of others.
    for_all_nodes([&](std::int64_t in_region, std::optional<std::int64_t>, bool is_at_border) {
      if (is_at_border) border_.push_back(in_region);
    });
    halo_.find(border_);
  }

  /// @param of_block `components` numbers a node of the block. Together.
  std::vector<double> bring(std::span<const double> of_block, int components) const {
    const auto n = static_cast<std::size_t>(components);
    const auto n_nodes = static_cast<std::size_t>(region_.nodes[0]) *
                         static_cast<std::size_t>(region_.nodes[1]) *
                         static_cast<std::size_t>(region_.nodes[2]);
    std::vector<double> of_piece(n * n_nodes), of_border(n * border_.size());
    for_all_nodes([&](std::int64_t in_region, std::optional<std::int64_t> in_block, bool) {
      if (in_block)
        std::copy_n(&of_block[n * static_cast<std::size_t>(*in_block)], n,
                    &of_piece[n * static_cast<std::size_t>(in_region)]);
    });
    for (std::size_t k = 0; k < border_.size(); ++k)
      std::copy_n(&of_piece[n * static_cast<std::size_t>(border_[k])], n, &of_border[n * k]);
    halo_.complete(components, of_border);
    for (std::size_t k = 0; k < border_.size(); ++k)
      std::copy_n(&of_border[n * k], n, &of_piece[n * static_cast<std::size_t>(border_[k])]);
    return of_piece;
  }

 private:
  /// Calls with the number of each node in the region, that in the block (none: another rank's), and whether
  /// it is in a first layer of the block or beyond its last.
  void for_all_nodes(const auto& call) const {
    std::int64_t in_region = 0;
    for (int z = region_.begin[2]; z < region_.begin[2] + region_.nodes[2]; ++z) {
      for (int y = region_.begin[1]; y < region_.begin[1] + region_.nodes[1]; ++y) {
        for (int x = region_.begin[0]; x < region_.begin[0] + region_.nodes[0]; ++x, ++in_region) {
          const ranks::Triple place = {x - block_.begin[0], y - block_.begin[1], z - block_.begin[2]};
          const bool is_own = place[0] < block_.n[0] && place[1] < block_.n[1] && place[2] < block_.n[2];
          const bool is_first = place[0] == 0 || place[1] == 0 || place[2] == 0;
          std::optional<std::int64_t> in_block;
          if (is_own) in_block = (std::int64_t{place[2]} * block_.n[1] + place[1]) * block_.n[0] + place[0];
          call(in_region, in_block, is_first || !is_own);
        }
      }
    }
  }

  ranks::Block block_;
  coupler::GridPart region_;
  RegionHalo halo_;
  std::vector<std::int64_t> border_;  ///< in the region, ascending
};

std::vector<Array> flow_of(const FluidPart& part) {
  const auto n = static_cast<std::size_t>(part.fluid.shape().size());
  Array density{"density", 1, std::vector<double>(n)}, velocity{"velocity", 3, std::vector<double>(3 * n)};
  part.fluid.moments(density.values, velocity.values);
  const auto force = part.fluid.force();
  std::vector<Array> arrays = {
      std::move(density), std::move(velocity), {"force", 3, {force.begin(), force.end()}}};
  if (!part.inside.empty()) arrays.push_back({"inside", 1, {part.inside.begin(), part.inside.end()}});
  return arrays;
}

/// A part has a viscosity of its nodes once one of them has another than that of the settings; all pieces
/// have it if any has.
std::vector<Array> state_of(const FluidPart& part) {
  std::vector<Array> arrays;
  bool has_viscosity = false;
  auto state = part.fluid.state();
  for (auto& array : state.arrays) {
    has_viscosity = has_viscosity || array.name == "viscosity";
    arrays.push_back({array.name, array.components, std::move(array.values)});
  }
  const bool any_has = part.world.highest(has_viscosity ? 1 : 0) > 0;
  if (any_has && !has_viscosity) {
    const auto n = static_cast<std::size_t>(part.fluid.shape().size());
    arrays.push_back({"viscosity", 1, std::vector<double>(n, part.base_viscosity)});
  }
  return arrays;
}

std::string name_in_folder(int rank) {
  return fmt::format("{}.vti", rank);
}

std::array<double, 3> origin_of(const Ranges3& range) {
  return {range[0][0] + 0.5, range[1][0] + 0.5, range[2][0] + 0.5};
}

void write(const exchange::GridPacket& packet, const PiecesOrder& what, int rank) {
  const auto folder = folder_of_pieces(what.index);
  std::filesystem::create_directories(folder);
  exchange::write_grid(folder / name_in_folder(rank), packet);
}

}  // namespace

void pack(ranks::Packing& packing, const PiecesOrder& what) {
  packing.put_text(what.index.string())
      .put(what.range)
      .put(what.is_state)
      .put(what.step)
      .put(what.shear_time);
}

PiecesOrder take_pieces_order(ranks::Unpacking& unpacking) {
  PiecesOrder what;
  what.index = unpacking.take_text();
  what.range = unpacking.take<Ranges3>();
  what.is_state = unpacking.take<bool>();
  what.step = unpacking.take<std::int64_t>();
  what.shear_time = unpacking.take<double>();
  return what;
}

PieceWritten write_piece(const FluidPart& part, const PiecesOrder& what) {
  const int rank = part.world.rank();
  const PieceNodes nodes(part.world, part.division, what.range);
  exchange::GridPacket packet;
  packet.origin = origin_of(what.range);
  packet.field_data = packet_header(what.step);
  if (!what.is_state) packet.field_data.push_back({"shear_time", 1, {what.shear_time}});
  packet.point_data = what.is_state ? state_of(part) : flow_of(part);
  PieceWritten written{"", {}, packet.field_data};
  for (auto& array : packet.point_data) {
    written.point_data.push_back({array.name, array.components});
    array.values = nodes.bring(array.values, array.components);
  }
  const auto piece = piece_of(part.division, rank, what.range);
  if (!piece) return written;
  packet.begin = piece->begin;
  packet.nodes = piece->nodes;
  try {
    write(packet, what, rank);
  } catch (const std::exception& error) {  // the others wait for the word of this rank
    written.error = error.what();
  }
  return written;
}

void write_index(const ranks::Division& division, const PiecesOrder& what, const PieceWritten& pieces) {
  exchange::GridIndex index;
  for (std::size_t axis = 0; axis < 3; ++axis)
    index.whole.nodes[axis] = what.range[axis][1] - what.range[axis][0] + 1;
  index.origin = origin_of(what.range);
  index.point_data = pieces.point_data;
  index.field_data = pieces.field_data;
  const auto folder = folder_of_pieces(what.index).filename();
  for (int rank = 0; rank < division.n_ranks(); ++rank) {
    if (const auto piece = piece_of(division, rank, what.range))
      index.pieces.push_back({(folder / name_in_folder(rank)).string(), *piece});
  }
  exchange::write_grid_index(what.index, index);
}

Ranges3 whole_range(const ranks::Triple& box) {
  return {{{0, box[0] - 1}, {0, box[1] - 1}, {0, box[2] - 1}}};
}

std::filesystem::path folder_of_pieces(const std::filesystem::path& index) {
  return index.parent_path() / index.stem();
}

fluid::State read_state_block(const std::filesystem::path& index_file, const ranks::Triple& box,
                              const ranks::Block& block) {
  const auto index = exchange::read_grid_index(index_file);
  if (index.whole != GridBlock{{0, 0, 0}, box}) {
    const auto& n = index.whole.nodes;
    throw std::invalid_argument(
        fmt::format("{}: a grid of {} x {} x {} nodes, the case has flow.box = [{}, "
                    "{}, {}]",
                    index_file.string(), n[0], n[1], n[2], box[0], box[1], box[2]));
  }
  return state_of(exchange::read_grid_block(index_file, index, {block.begin, block.n}), index_file.string());
}

}  // namespace tanktread::driver
