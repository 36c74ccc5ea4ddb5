#include "driver/system/fluid_pieces.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <optional>
#include <utility>

#include "driver/packets/packet_files.hpp"
#include "driver/program/file_system_error.hpp"
#include "driver/system/piece_nodes.hpp"
#include "exchange/grid_writer.hpp"
#include "exchange/vtk_files.hpp"

namespace tanktread::driver {
namespace {

/// An array of a piece, of which a rank has the numbers of its block.
struct PartArray {
  exchange::ArrayShape shape;
  NodeNumbers numbers;
};

/// A rank's fluid, divided or not.
struct Part {
  const ranks::World* world;  ///< null: not divided
  const ranks::Division& division;
  const fluid::Fluid& fluid;
  double base_viscosity;  ///< of nodes that have none of their own
  std::span<const std::int32_t> inside;

  int rank() const { return world != nullptr ? world->rank() : 0; }
  bool any(bool of_this_rank) const {
    return world != nullptr ? world->highest(of_this_rank ? 1 : 0) > 0 : of_this_rank;
  }
};

/// Takes numbers out of an array of all nodes.
NodeNumbers out_of(const auto& of_all, int components, const fluid::GridShape& shape) {
  return {components, [of_all, components, shape](fluid::Layers layers, std::span<double> values) {
            const auto first = std::int64_t{components} * shape.nx * shape.ny * layers.begin;
            std::ranges::copy(of_all.subspan(static_cast<std::size_t>(first), values.size()), values.begin());
          }};
}

std::vector<PartArray> flow_of(const Part& part) {
  const auto& fluid = part.fluid;
  const auto density = [&fluid](fluid::Layers layers, std::span<double> values) {
    std::vector<double> velocity(3 * values.size());
    fluid.moments_of_layers(layers, values, velocity);
  };
  const auto velocity = [&fluid](fluid::Layers layers, std::span<double> values) {
    std::vector<double> beside(values.size() / 3);
    fluid.moments_of_layers(layers, beside, values);
  };
  std::vector<PartArray> arrays = {{{"density", 1}, {1, density}},
                                   {{"velocity", 3}, {3, velocity}},
                                   {{"force", 3}, out_of(fluid.force(), 3, fluid.shape())}};
  if (!part.inside.empty()) arrays.push_back({{"inside", 1}, out_of(part.inside, 1, fluid.shape())});
  return arrays;
}

/// A part has a viscosity of its nodes once one of them has another than that of the settings; all pieces
/// have it if any has.
std::vector<PartArray> state_of(const Part& part) {
  std::vector<PartArray> arrays;
  bool has_viscosity = false;
  for (const auto& [name, components] : part.fluid.state_shape().arrays) {
    has_viscosity = has_viscosity || name == "viscosity";
    const auto of_layers = [&fluid = part.fluid, array = name](fluid::Layers layers,
                                                               std::span<double> values) {
      fluid.state_of_layers(array, layers, values);
    };
    arrays.push_back({{name, components}, {components, of_layers}});
  }
  if (part.any(has_viscosity) && !has_viscosity) {
    const auto of_settings = [viscosity = part.base_viscosity](fluid::Layers, std::span<double> values) {
      std::ranges::fill(values, viscosity);
    };
    arrays.push_back({{"viscosity", 1}, {1, of_settings}});
  }
  return arrays;
}

std::string name_in_folder(int rank) {
  return fmt::format("{}.vti", rank);
}

std::array<double, 3> origin_of(const Ranges3& range) {
  return {range[0][0] + 0.5, range[1][0] + 0.5, range[2][0] + 0.5};
}

/// The file of a rank's piece, if it has one. What goes wrong is kept: the others wait for the word of this
/// rank.
class PieceFile {
 public:
  PieceFile(const Part& part, const PiecesOrder& what, const std::vector<exchange::Array>& field_data,
            const std::vector<exchange::ArrayShape>& point_data) {
    const auto piece = piece_of(part.division, part.rank(), what.range);
    if (!piece) return;
    try_to([&] {
      const auto folder = folder_of_pieces(what.index);
      std::filesystem::create_directories(folder);
      const exchange::GridPacket grid{piece->nodes, origin_of(what.range), {1, 1, 1}, piece->begin, {},
                                      field_data};
      writer_.emplace(folder / name_in_folder(part.rank()), grid, point_data);
    });
  }

  void add(std::span<const double> values) {
    if (writer_) try_to([&] { writer_->add(values); });
  }
  /// @return what went wrong; "": nothing
  std::string finish() {
    if (writer_) try_to([&] { writer_->finish(); });
    return error_;
  }

 private:
  void fail(std::string error) {
    error_ = std::move(error);
    writer_.reset();
  }
  template <class Do>
  void try_to(const Do& act) {
    try {
      act();
    } catch (const std::filesystem::filesystem_error& error) {
      fail(message_of(error));
    } catch (const std::exception& error) {
      fail(error.what());
    }
  }

  std::optional<exchange::GridWriter> writer_;
  std::string error_;
};

PieceWritten write(const Part& part, const PiecesOrder& what) {
  const PieceNodes nodes(part.world, part.division, what.range);
  PieceWritten written{"", {}, packet_header(what.step)};
  if (!what.is_state) written.field_data.push_back({"shear_time", 1, {what.shear_time}});
  const auto arrays = what.is_state ? state_of(part) : flow_of(part);
  for (const auto& array : arrays) written.point_data.push_back(array.shape);
  PieceFile file(part, what, written.field_data, written.point_data);
  for (const auto& array : arrays)
    nodes.for_layers(array.numbers, [&](std::span<const double> values) { file.add(values); });
  written.error = file.finish();
  return written;
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
  return write({&part.world, part.division, part.fluid, part.base_viscosity, part.inside}, what);
}

void write_as_one_piece(const fluid::Fluid& fluid, std::span<const std::int32_t> inside,
                        const PiecesOrder& what) {
  const auto shape = fluid.shape();
  const ranks::Division division(ranks::Box{{shape.nx, shape.ny, shape.nz}}, {1, 1, 1});
  const auto written = write({nullptr, division, fluid, 0, inside}, what);
  if (!written.error.empty()) throw exchange::FileError(written.error);
  write_index(division, what, written);
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

}  // namespace tanktread::driver
