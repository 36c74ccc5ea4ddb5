#include "driver/diff/packet_difference.hpp"

#include <fmt/format.h>

#include "exchange/vtk_files.hpp"

namespace tanktread::driver {
namespace {

using exchange::ArrayDifference, exchange::GridPacket, exchange::SurfacePacket;

/// "value 53 (node 17, component 2)"; `owner` names what tuple 17 belongs to.
std::string place(std::int64_t index, int components, const std::string& owner) {
  if (components == 1) return fmt::format("value {} ({})", index, owner);
  return fmt::format("value {} ({}, component {})", index, owner, index % components);
}

std::string place(const SurfacePacket& surface, const ArrayDifference& array, std::int64_t index) {
  const auto tuple = index / array.components;
  if (array.kind == "points" || array.kind == "point data") {
    const double* position = surface.points.data() + 3 * tuple;
    return place(
        index, array.components,
        fmt::format("node {} at {:.6g} {:.6g} {:.6g}", tuple, position[0], position[1], position[2]));
  }
  const bool on_triangles = array.kind == "triangles" || array.kind == "cell data";
  return place(index, array.components, fmt::format("{} {}", on_triangles ? "triangle" : "tuple", tuple));
}

std::string place(const GridPacket& grid, const ArrayDifference& array, std::int64_t index) {
  if (array.kind == "geometry") return fmt::format("{}", "xyz"[index]);
  const auto tuple = index / array.components;
  if (array.kind != "point data") return place(index, array.components, fmt::format("tuple {}", tuple));
  const std::int64_t nx = grid.nodes[0], ny = grid.nodes[1];
  return place(index, array.components,
               fmt::format("node {} {} {}", tuple % nx, tuple / nx % ny, tuple / (nx * ny)));
}

template <class Packet>
void add_all(const Packet& a, const Packet& b, DifferenceReport& report) {
  for (const auto& array : exchange::differences(a, b)) {
    report.add(array, {[&](std::int64_t index) { return place(a, array, index); }, {}, {}});
  }
}

}  // namespace

void compare_surfaces(const std::filesystem::path& a, const std::filesystem::path& b,
                      DifferenceReport& report) {
  add_all(exchange::read_surface(a, true), exchange::read_surface(b, true), report);
}

void compare_grids(const std::filesystem::path& a, const std::filesystem::path& b, DifferenceReport& report) {
  add_all(exchange::read_grid(a, true), exchange::read_grid(b, true), report);
}

}  // namespace tanktread::driver
