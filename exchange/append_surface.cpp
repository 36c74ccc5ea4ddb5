#include "exchange/append_surface.hpp"

#include <stdexcept>

namespace tanktread::exchange {
namespace {

void append(std::vector<double>& values, const std::vector<double>& more) {
  values.insert(values.end(), more.begin(), more.end());
}

void append_arrays(std::vector<Array>& to, const std::vector<Array>& other) {
  for (auto& array : to) {
    const auto* more = find_optional_array(other, array.name);
    if (more == nullptr || more->components != array.components)
      throw std::invalid_argument("a surface to be appended has no array '" + array.name +
                                  "' of as many components");
    append(array.values, more->values);
  }
}

}  // namespace

void append_surface(SurfacePacket& to, const SurfacePacket& other) {
  const auto first_node = static_cast<std::int64_t>(to.points.size() / 3);
  append(to.points, other.points);
  for (const auto corner : other.triangles) to.triangles.push_back(first_node + corner);
  append_arrays(to.point_data, other.point_data);
  append_arrays(to.cell_data, other.cell_data);
}

}  // namespace tanktread::exchange
