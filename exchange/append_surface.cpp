#include "exchange/append_surface.hpp"

#include <fmt/format.h>

#include <utility>

namespace tanktread::exchange {
namespace {

void append_arrays(std::vector<Array>& to, const std::vector<Array>& other, const char* which) {
  if (to.size() != other.size())
    throw std::invalid_argument(
        fmt::format("surfaces with {} and {} arrays of {} cannot be one", to.size(), other.size(), which));
  for (std::size_t k = 0; k < to.size(); ++k) {
    if (to[k].name != other[k].name || to[k].components != other[k].components) {
      throw std::invalid_argument(
          fmt::format("surfaces with the {} '{}' of {} components and '{}' of {} cannot be one", which,
                      to[k].name, to[k].components, other[k].name, other[k].components));
    }
    to[k].values.insert(to[k].values.end(), other[k].values.begin(), other[k].values.end());
  }
}

}  // namespace

void append_surface(SurfacePacket& to, SurfacePacket other) {
  if (to.points.empty() && to.triangles.empty()) {
    to = std::move(other);
    return;
  }
  const auto first_node = static_cast<std::int64_t>(to.points.size() / 3);
  append_arrays(to.point_data, other.point_data, "point data");
  append_arrays(to.cell_data, other.cell_data, "cell data");
  to.points.insert(to.points.end(), other.points.begin(), other.points.end());
  for (const std::int64_t node : other.triangles) to.triangles.push_back(first_node + node);
  for (auto& array : other.field_data) {
    if (find_optional_array(to.field_data, array.name) == nullptr) to.field_data.push_back(std::move(array));
  }
}

}  // namespace tanktread::exchange
