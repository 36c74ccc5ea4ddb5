#include "driver/outside/outside_fluid.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "driver/packets/packet_files.hpp"

namespace tanktread::driver {
namespace {

using exchange::Array;
using exchange::GridPacket;

constexpr const char* force_name = "force";

void check_size(const char* what, std::size_t size, std::size_t wanted) {
  if (size == wanted) return;
  throw std::invalid_argument(fmt::format("{}: {} numbers, {} are needed", what, size, wanted));
}

/// The axis as a program reads it; -1: there are no walls.
double wall_axis(const FlowCase& flow) {
  return flow.kind == "periodic" ? -1.0 : flow.wall_axis;
}

std::vector<Array> constants(const Case& the_case, const FlowParameters& parameters) {
  const auto& flow = the_case.flow;
  const auto& force = parameters.body_force;
  return {{"kinematic_viscosity", 1, {parameters.kinematic_viscosity}},
          {"relaxation_time", 1, {parameters.relaxation_time}},
          {"inertia", 1, {flow.inertia ? 1.0 : 0.0}},
          {"body_force", 3, {force.begin(), force.end()}},
          // The speed of Poiseuille flow is that of its middle; its walls are at rest.
          {"wall_speed", 1, {flow.kind == "shear" ? parameters.wall_speed : 0.0}},
          {"wall_axis", 1, {wall_axis(flow)}},
          {"flow_axis", 1, {static_cast<double>(flow.flow_axis)}}};
}

/// Takes the array of that name out of a state. @throws std::invalid_argument
Array take(std::vector<Array>& arrays, const char* name, int components, std::size_t n_nodes) {
  const auto found = std::ranges::find(arrays, name, &Array::name);
  if (found == arrays.end()) throw std::invalid_argument(fmt::format("the array '{}' is missing", name));
  if (found->components != components || found->values.size() != n_nodes * std::size_t(components)) {
    throw std::invalid_argument(
        fmt::format("the array '{}' has {} numbers of {} components, expected {} x {}", name,
                    found->values.size(), found->components, n_nodes, components));
  }
  auto array = std::move(*found);
  arrays.erase(found);
  return array;
}

}  // namespace

OutsideFluid::OutsideFluid(const Case& the_case, const FlowParameters& parameters, const fluid::Fluid& start)
    : program_(the_case.flow.command, the_case.run, "fluid", "fluid"),
      constants_(constants(the_case, parameters)),
      shape_(start.shape()),
      speed_limit_(parameters.speed_limit) {
  const auto n_nodes = static_cast<std::size_t>(shape_.size());
  force_.assign(3 * n_nodes, 0.0);
  arrays_ = {{"density", 1, std::vector<double>(n_nodes)}, {"velocity", 3, std::vector<double>(3 * n_nodes)}};
  start.moments(arrays_[0].values, arrays_[1].values);
}

void OutsideFluid::velocity(std::span<const std::int64_t> nodes, std::span<double> velocity) const {
  check_size("velocity()", velocity.size(), 3 * nodes.size());
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    check_node(nodes[k]);
    std::copy_n(&arrays_[1].values[3 * static_cast<std::size_t>(nodes[k])], 3, &velocity[3 * k]);
  }
}

void OutsideFluid::free_velocity(std::span<const std::int64_t>, std::span<double>, std::span<double>) const {
  throw std::logic_error(
      "flow.command: a program in the place of the fluid is not asked for the velocity of the step to come");
}

void OutsideFluid::dissipation(std::span<double>) const {
  throw std::logic_error(
      "flow.command: a program in the place of the fluid is not asked for its dissipation");
}

void OutsideFluid::wall_power(std::span<double>) const {
  throw std::logic_error(
      "flow.command: a program in the place of the fluid is not asked for the power of the walls");
}

void OutsideFluid::moments(std::span<double> density, std::span<double> velocity) const {
  check_size("moments(): density", density.size(), arrays_[0].values.size());
  check_size("moments(): velocity", velocity.size(), arrays_[1].values.size());
  std::ranges::copy(arrays_[0].values, density.begin());
  std::ranges::copy(arrays_[1].values, velocity.begin());
}

void OutsideFluid::moments_of_layers(fluid::Layers layers, std::span<double> density,
                                     std::span<double> velocity) const {
  state_of_layers("density", layers, density);
  state_of_layers("velocity", layers, velocity);
}

void OutsideFluid::add_force(std::span<const std::int64_t> nodes, std::span<const double> force) {
  check_size("add_force()", force.size(), 3 * nodes.size());
  for (const auto node : nodes) check_node(node);
  for (std::size_t k = 0; k < force.size(); ++k)
    force_[3 * static_cast<std::size_t>(nodes[k / 3]) + k % 3] += force[k];
}

void OutsideFluid::clear_force() {
  std::ranges::fill(force_, 0.0);
}

void OutsideFluid::set_viscosity(std::span<const double>) {
  throw std::invalid_argument("flow.command: a program in the place of the fluid has one viscosity");
}

void OutsideFluid::set_viscosity(std::span<const std::int64_t>, std::span<const double> kinematic_viscosity) {
  set_viscosity(kinematic_viscosity);
}

double OutsideFluid::step() {
  arrays_ = program_.in_step(step_ + 1, [&] { return taken(program_.ask(input())); });
  ++step_;
  return highest_speed();
}

GridPacket OutsideFluid::input() const {
  GridPacket packet;
  packet.nodes = {shape_.nx, shape_.ny, shape_.nz};
  packet.point_data = {{force_name, 3, force_}};
  packet.point_data.insert(packet.point_data.end(), arrays_.begin(), arrays_.end());
  packet.field_data = packet_header(step_);
  packet.field_data.insert(packet.field_data.end(), constants_.begin(), constants_.end());
  return packet;
}

std::vector<Array> OutsideFluid::taken(Reply<GridPacket> reply) const {
  auto& [packet, file] = reply;
  check_grid(packet, {shape_.nx, shape_.ny, shape_.nz}, file);
  check_reply_step(packet.field_data, step_ + 1, file);
  const auto n_nodes = static_cast<std::size_t>(shape_.size());
  reply_array(packet.point_data, "density", 1, n_nodes, "point data", file);
  reply_array(packet.point_data, "velocity", 3, n_nodes, "point data", file);
  std::erase_if(packet.point_data, [](const Array& array) { return array.name == force_name; });
  std::vector<Array> arrays = {take(packet.point_data, "density", 1, n_nodes),
                               take(packet.point_data, "velocity", 3, n_nodes)};
  std::ranges::move(packet.point_data, std::back_inserter(arrays));
  return arrays;
}

double OutsideFluid::highest_speed() const {
  double highest = 0;
  const auto& density = arrays_[0].values;
  for (std::size_t node = 0; node < density.size(); ++node) {
    const double* u = &arrays_[1].values[3 * node];
    const double speed = std::sqrt(u[0] * u[0] + u[1] * u[1] + u[2] * u[2]);
    highest = std::max(highest, speed);
    if (speed < speed_limit_ && std::isfinite(density[node])) continue;
    const auto x = static_cast<std::int64_t>(node) % shape_.nx,
               row = static_cast<std::int64_t>(node) / shape_.nx;
    throw fluid::Breakdown(
        fmt::format("step {}: the program of the {}: the velocity at node ({}, {}, {}) is ({}, "
                    "{}, {}), density {}; both must be finite, and the speed below flow.speed_limit, {}",
                    step_, program_.name(), x, row % shape_.ny, row / shape_.ny, u[0], u[1], u[2],
                    density[node], speed_limit_));
  }
  return highest;
}

fluid::State OutsideFluid::state() const {
  fluid::State state;
  state.step = step_;
  for (const auto& array : arrays_) state.arrays.push_back({array.name, array.components, array.values});
  state.arrays.push_back({force_name, 3, force_});
  return state;
}

fluid::StateShape OutsideFluid::state_shape() const {
  fluid::StateShape shape{step_, {}};
  for (const auto& array : arrays_) shape.arrays.push_back({array.name, array.components});
  shape.arrays.push_back({force_name, 3});
  return shape;
}

std::span<const double> OutsideFluid::state_array(const std::string& name) const {
  return name == force_name ? std::span(force_) : exchange::find_array(arrays_, name, program_.name()).values;
}

void OutsideFluid::state_of_layers(const std::string& name, fluid::Layers layers,
                                   std::span<double> values) const {
  const auto all = state_array(name);
  const auto n_a_layer = all.size() / static_cast<std::size_t>(shape_.nz);
  if (layers.begin < 0 || layers.end < layers.begin || layers.end > shape_.nz)
    throw std::invalid_argument(
        fmt::format("layers up to {} are asked for, the box has {}", layers.end, shape_.nz));
  check_size(name.c_str(), values.size(), n_a_layer * static_cast<std::size_t>(layers.end - layers.begin));
  std::ranges::copy(all.subspan(n_a_layer * static_cast<std::size_t>(layers.begin), values.size()),
                    values.begin());
}

void OutsideFluid::restore(const fluid::State& state) {
  const auto n_nodes = static_cast<std::size_t>(shape_.size());
  std::vector<Array> given;
  for (const auto& array : state.arrays) given.push_back({array.name, array.components, array.values});
  std::vector<Array> arrays = {take(given, "density", 1, n_nodes), take(given, "velocity", 3, n_nodes)};
  auto force = take(given, force_name, 3, n_nodes);
  for (auto& array : given)
    check_size(array.name.c_str(), array.values.size(), n_nodes * std::size_t(array.components));
  std::ranges::move(given, std::back_inserter(arrays));
  arrays_ = std::move(arrays);
  force_ = std::move(force.values);
  step_ = state.step;
}

void OutsideFluid::check_node(std::int64_t node) const {
  if (node >= 0 && node < shape_.size()) return;
  throw std::invalid_argument(fmt::format("node {} lies outside the box of {} nodes", node, shape_.size()));
}

}  // namespace tanktread::driver
