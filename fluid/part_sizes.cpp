#include "fluid/part_sizes.hpp"

#include "fluid/part_border.hpp"
#include "fluid/population_lattice.hpp"
#include "fluid/settings.hpp"

namespace tanktread::fluid {

std::int64_t PartSizes::message_bytes() const {
  std::int64_t sum = 0;
  for (const auto& message : messages) sum += message.bytes;
  return sum;
}

PartSizes part_sizes(const LatticeBoltzmannSettings& settings, const GridPart& part) {
  check(settings);
  check(part, settings.shape);
  const PartBorder border(settings.shape, settings.walls, part);
  const int number = bytes_of_number(settings.storage);
  PartSizes sizes;
  sizes.nodes = part.shape.size();
  std::int64_t with_halo = 1;
  for (int axis = 0; axis < 3; ++axis) with_halo *= border.n()[axis] + 2 * border.halo(axis);
  sizes.halo_nodes = with_halo - sizes.nodes;
  sizes.population_bytes = number * layout_of(border, number).n_numbers();
  for (const auto& direction : halo_directions(border)) {
    std::int64_t n = 0;
    for (const auto& links : crossing_links(border, direction, false)) n += links.size();
    sizes.messages.push_back({direction, number * n});
  }
  return sizes;
}

}  // namespace tanktread::fluid
