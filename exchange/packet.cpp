#include "exchange/packet.hpp"

#include <algorithm>

namespace tanktread::exchange {

// In one place, for all that compare bits: elsewhere the product and the sum might be fused.
std::array<double, 3> first_node(const GridPacket& packet) {
  std::array<double, 3> position = packet.origin;
  for (std::size_t axis = 0; axis < 3; ++axis) position[axis] += packet.begin[axis] * packet.spacing[axis];
  return position;
}

const Array* find_optional_array(const std::vector<Array>& arrays, const std::string& name) {
  const auto found = std::ranges::find(arrays, name, &Array::name);
  return found == arrays.end() ? nullptr : &*found;
}

const Array& find_array(const std::vector<Array>& arrays, const std::string& name, const std::string& where) {
  if (const auto* found = find_optional_array(arrays, name)) return *found;
  std::string present;
  for (const auto& array : arrays) {
    present += (present.empty() ? "" : ", ") + array.name;
  }
  throw FileError(where + ": array '" + name +
                  "' is missing; there are: " + (present.empty() ? "none" : present));
}

}  // namespace tanktread::exchange
