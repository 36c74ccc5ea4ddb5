#include "exchange/grid_pieces.hpp"

#include <algorithm>

namespace tanktread::exchange {

GridPacket read_grid_block(const std::filesystem::path& file, const GridIndex& index, const GridBlock& block,
                           bool convert) {
  const GridBlockReader reader(file, index, block, convert);
  GridPacket result{block.nodes, index.origin, index.spacing, block.begin, {}, index.field_data};
  std::size_t n_nodes = 1;
  for (const int n : block.nodes) n_nodes *= static_cast<std::size_t>(n);
  for (const auto& [name, components] : index.point_data) {
    result.point_data.push_back({name, components, {}});
    auto& values = result.point_data.back().values;
    values.resize(n_nodes * static_cast<std::size_t>(components));
    reader.read(name, 0, block.nodes[2], values);
  }
  return result;
}

}  // namespace tanktread::exchange
