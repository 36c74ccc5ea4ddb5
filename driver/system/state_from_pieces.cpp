#include "driver/system/state_from_pieces.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

#include "driver/packets/packet_files.hpp"
#include "exchange/vtk_files.hpp"

namespace tanktread::driver {
namespace {

exchange::GridIndex index_of(const std::filesystem::path& file, const ranks::Triple& box) {
  auto index = exchange::read_grid_index(file);
  if (index.whole != exchange::GridBlock{{0, 0, 0}, box}) {
    const auto& n = index.whole.nodes;
    throw std::invalid_argument(
        fmt::format("{}: a grid of {} x {} x {} nodes, the case has flow.box = [{}, "
                    "{}, {}]",
                    file.string(), n[0], n[1], n[2], box[0], box[1], box[2]));
  }
  return index;
}

fluid::StateShape shape_of(const exchange::GridIndex& index, const std::string& name) {
  check_schema_version(index.field_data, name);
  fluid::StateShape shape{step_of(index.field_data, name), {}};
  for (const auto& array : index.point_data) shape.arrays.push_back({array.name, array.components});
  return shape;
}

/// Another rank cannot take its part over.
struct RefusedElsewhere {};

/// A source that all ranks accept, or none.
class TogetherAccepted final : public fluid::StateSource {
 public:
  TogetherAccepted(const fluid::StateSource& own, const ranks::World& world) : own_(own), world_(world) {}

  fluid::StateShape shape() const override { return own_.shape(); }
  void read(const std::string& array, fluid::Layers layers, std::span<double> values) const override {
    own_.read(array, layers, values);
  }
  void accepted() const override {
    is_asked = true;
    if (world_.highest(0) > 0) throw RefusedElsewhere();
  }

  mutable bool is_asked = false;

 private:
  const fluid::StateSource& own_;
  const ranks::World& world_;
};

}  // namespace

StateFromPieces::StateFromPieces(const std::filesystem::path& file, const ranks::Triple& box,
                                 const ranks::Block& block)
    : StateFromPieces(file, index_of(file, box), block) {}

StateFromPieces::StateFromPieces(const std::filesystem::path& file, const exchange::GridIndex& index,
                                 const ranks::Block& block)
    : shape_(shape_of(index, file.string())), reader_(file, index, {block.begin, block.n}) {}

void StateFromPieces::read(const std::string& array, fluid::Layers layers, std::span<double> values) const {
  reader_.read(array, layers.begin, layers.end, values);
}

void restore_from_pieces(fluid::Fluid& fluid, const std::filesystem::path& index) {
  const auto shape = fluid.shape();
  const ranks::Triple box = {shape.nx, shape.ny, shape.nz};
  fluid.restore_from(StateFromPieces(index, box, {{0, 0, 0}, box}));
}

void pack(ranks::Packing& packing, const RestoreAnswer& answer) {
  packing.put_text(answer.error).put(answer.is_of_files);
}

RestoreAnswer take_restore_answer(ranks::Unpacking& unpacking) {
  RestoreAnswer answer;
  answer.error = unpacking.take_text();
  answer.is_of_files = unpacking.take<bool>();
  return answer;
}

RestoreAnswer restore_part(const ranks::World& world, fluid::Fluid& part, const ranks::Division& division,
                           const std::filesystem::path& index) {
  RestoreAnswer answer;
  bool all_know = false;
  try {
    const StateFromPieces state(index, division.box().n, division.block(world.rank()));
    const TogetherAccepted source(state, world);
    try {
      part.restore_from(source);
    } catch (...) {
      all_know = source.is_asked;
      throw;
    }
    return {};
  } catch (const RefusedElsewhere&) {
  } catch (const exchange::FileError& error) {
    answer = {error.what(), true};
  } catch (const std::invalid_argument& error) {
    answer = {error.what(), false};
  }
  if (!all_know) world.highest(1);
  return answer;
}

}  // namespace tanktread::driver
