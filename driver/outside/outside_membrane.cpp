#include "driver/outside/outside_membrane.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "driver/packets/packet_files.hpp"
#include "driver/packets/surface_mesh.hpp"

namespace tanktread::driver {
namespace {

using exchange::Array;
using exchange::FileError;
using exchange::SurfacePacket;

constexpr const char* force_name = "total_force";
/// What a reply gives back of what it was given is not the program's state.
constexpr const char* given[] = {"velocity", "reference_position", force_name};

void check_geometry(const SurfacePacket& reply, const SurfacePacket& input, const std::string& file) {
  const auto n_nodes = input.points.size() / 3, n_triangles = input.triangles.size() / 3;
  if (reply.points.size() / 3 != n_nodes || reply.triangles.size() / 3 != n_triangles) {
    throw FileError(
        fmt::format("{}: {} nodes and {} triangles; expected those of the packet it was given, {} "
                    "and {}",
                    file, reply.points.size() / 3, reply.triangles.size() / 3, n_nodes, n_triangles));
  }
  const auto differing = std::ranges::mismatch(reply.points, input.points).in1 - reply.points.begin();
  if (reply.triangles == input.triangles && differing == std::ssize(reply.points)) return;
  const auto what = reply.triangles == input.triangles ? fmt::format("node {} lies elsewhere", differing / 3)
                                                       : std::string("the triangles are others");
  throw FileError(
      fmt::format("{}: not of the packet it was given: {}; expected the same nodes and triangles, "
                  "of this step",
                  file, what));
}

void check_finite(const Array& force, const std::string& file) {
  const auto bad = std::ranges::find_if_not(force.values, [](double value) { return std::isfinite(value); });
  if (bad == force.values.end()) return;
  const auto node = (bad - force.values.begin()) / 3;
  const double* at = &force.values[3 * static_cast<std::size_t>(node)];
  throw FileError(fmt::format("{}: '{}' is not finite at node {}: ({}, {}, {}); expected finite numbers",
                              file, force.name, node, at[0], at[1], at[2]));
}

void check_sizes(const std::vector<Array>& arrays, int n_tuples, const char* what) {
  for (const auto& array : arrays) {
    if (array.values.size() == std::size_t(n_tuples) * std::size_t(array.components)) continue;
    throw std::invalid_argument(
        fmt::format("the program's array '{}' has {} numbers of {} components, expected "
                    "one for each of {} {}",
                    array.name, array.values.size(), array.components, n_tuples, what));
  }
}

}  // namespace

OutsideMembrane::OutsideMembrane(const Case& the_case, const Parameters& parameters, std::size_t number)
    : program_(the_case.capsules[number].membrane.command, the_case.run, fmt::format("membrane_{}", number),
               fmt::format("membrane of capsule {}", number)),
      shear_rate_(parameters.shear_rate) {
  const auto& capsule = parameters.capsules[number];
  constants_ = {{"capsule", 1, {static_cast<double>(number)}},
                {"radius", 1, {capsule.radius}},
                {"shear_modulus", 1, {capsule.shear_modulus}},
                {"area_modulus", 1, {capsule.area_modulus}},
                {"skalak_modulus", 1, {capsule.skalak_modulus}},
                {"interfacial_tension", 1, {capsule.interfacial_tension}}};
}

SurfacePacket OutsideMembrane::input(const membrane::Membrane& membrane, const Eigen::Matrix3Xd& velocity,
                                     std::int64_t step) const {
  auto packet = surface_packet({membrane.positions(), membrane.reference().triangles});
  packet.point_data = {{"velocity", 3, to_values(velocity)},
                       {"reference_position", 3, to_values(membrane.reference().points)}};
  packet.point_data.insert(packet.point_data.end(), state_.point_data.begin(), state_.point_data.end());
  packet.cell_data = state_.cell_data;
  packet.field_data = packet_header(step);
  packet.field_data.push_back({"shear_time", 1, {static_cast<double>(step) * shear_rate_}});
  packet.field_data.insert(packet.field_data.end(), constants_.begin(), constants_.end());
  return packet;
}

Eigen::Matrix3Xd OutsideMembrane::taken(Reply<SurfacePacket> reply, const SurfacePacket& input,
                                        std::int64_t step) {
  auto& [packet, file] = reply;
  check_geometry(packet, input, file);
  check_reply_step(packet.field_data, step, file);
  const auto& force =
      reply_array(packet.point_data, force_name, 3, input.points.size() / 3, "point data", file);
  check_finite(force, file);
  auto result = to_matrix(force.values);
  std::erase_if(packet.point_data,
                [](const Array& array) { return std::ranges::count(given, array.name) > 0; });
  state_ = {std::move(packet.point_data), std::move(packet.cell_data)};
  return result;
}

Eigen::Matrix3Xd OutsideMembrane::forces(const membrane::Membrane& membrane, const Eigen::Matrix3Xd& velocity,
                                         std::int64_t step) {
  return program_.in_step(step, [&] {
    const auto packet = input(membrane, velocity, step);
    return taken(program_.ask(packet), packet, step);
  });
}

void OutsideMembrane::restore(SurfaceArrays state, const membrane::Membrane& membrane) {
  check_sizes(state.point_data, membrane.n_nodes(), "nodes");
  check_sizes(state.cell_data, membrane.n_triangles(), "triangles");
  state_ = std::move(state);
}

}  // namespace tanktread::driver
