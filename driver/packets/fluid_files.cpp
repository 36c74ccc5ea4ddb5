#include "driver/packets/fluid_files.hpp"

#include "driver/packets/packet_files.hpp"

namespace tanktread::driver {
namespace {

using exchange::Array;

/// The rows along x of a part of the box, one after the other.
std::vector<double> cut(std::span<const double> all, int components, const fluid::GridShape& shape,
                        const Ranges3& part) {
  std::vector<double> values;
  for (int z = part[2][0]; z <= part[2][1]; ++z) {
    for (int y = part[1][0]; y <= part[1][1]; ++y) {
      const auto first = all.begin() + components * shape.index(part[0][0], y, z);
      values.insert(values.end(), first, first + components * (part[0][1] - part[0][0] + 1));
    }
  }
  return values;
}

}  // namespace

exchange::GridPacket flow_file(const fluid::Fluid& fluid, const std::optional<Ranges3>& part,
                               std::int64_t step, double shear_time, std::span<const std::int32_t> inside) {
  const auto shape = fluid.shape();
  std::vector<double> density(static_cast<std::size_t>(shape.size())), velocity(3 * density.size());
  fluid.moments(density, velocity);
  const Ranges3 whole = {{{0, shape.nx - 1}, {0, shape.ny - 1}, {0, shape.nz - 1}}};
  const auto range = part.value_or(whole);
  exchange::GridPacket file;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    file.nodes[axis] = range[axis][1] - range[axis][0] + 1;
    file.origin[axis] = range[axis][0] + 0.5;
  }
  file.point_data = {{"density", 1, cut(density, 1, shape, range)},
                     {"velocity", 3, cut(velocity, 3, shape, range)},
                     {"force", 3, cut(fluid.force(), 3, shape, range)}};
  if (!inside.empty()) {
    const std::vector<double> marks(inside.begin(), inside.end());
    file.point_data.push_back({"inside", 1, cut(marks, 1, shape, range)});
  }
  file.field_data = packet_header(step);
  file.field_data.push_back({"shear_time", 1, {shear_time}});
  return file;
}

exchange::GridPacket state_file(fluid::State state, const fluid::GridShape& shape) {
  exchange::GridPacket file;
  file.nodes = {shape.nx, shape.ny, shape.nz};
  for (auto& array : state.arrays)
    file.point_data.push_back({array.name, array.components, std::move(array.values)});
  file.field_data = packet_header(state.step);
  return file;
}

}  // namespace tanktread::driver
