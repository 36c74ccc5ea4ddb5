// A flow solver that is a user's program.
#pragma once

#include <cstdint>
#include <vector>

#include "driver/outside/outside_program.hpp"
#include "driver/units/flow_units.hpp"
#include "fluid/fluid.hpp"

namespace tanktread::driver {

/// Density and velocity are those of the program's last reply. What goes to and fro:
/// docs/outside-programs.md. The arrays of its state are all point arrays of that reply, "density" and
/// "velocity" among them, and "force".
class OutsideFluid final : public fluid::Fluid {
 public:
  /// Starts the program. @param start a solver of that case at its start, whose density and velocity are the
  /// first ones here
  /// @throws InputError if that fails
  OutsideFluid(const Case& the_case, const FlowParameters& parameters, const fluid::Fluid& start);

  fluid::GridShape shape() const override { return shape_; }
  void velocity(std::span<const std::int64_t> nodes, std::span<double> velocity) const override;
  /// @throws std::logic_error always: a program is asked for its flow after a step, not for what it would be
  void free_velocity(std::span<const std::int64_t> nodes, std::span<double> velocity,
                     std::span<double> mobility) const override;
  /// @throws std::logic_error always, both: a program tells density and velocity alone
  void dissipation(std::span<double> power) const override;
  void wall_power(std::span<double> power) const override;
  void moments(std::span<double> density, std::span<double> velocity) const override;
  void moments_of_layers(fluid::Layers layers, std::span<double> density,
                         std::span<double> velocity) const override;
  void add_force(std::span<const std::int64_t> nodes, std::span<const double> force) override;
  void clear_force() override;
  std::span<const double> force() const override { return force_; }
  /// @throws std::invalid_argument always: a program is not asked whether it heeds a viscosity of each node
  void set_viscosity(std::span<const double> kinematic_viscosity) override;
  void set_viscosity(std::span<const std::int64_t> nodes,
                     std::span<const double> kinematic_viscosity) override;
  /// @throws fluid::Breakdown; RunError that names step, program, packet and array
  double step() override;
  fluid::State state() const override;
  fluid::StateShape state_shape() const override;
  void state_of_layers(const std::string& array, fluid::Layers layers,
                       std::span<double> values) const override;
  void restore(const fluid::State& state) override;

 private:
  exchange::GridPacket input() const;
  std::span<const double> state_array(const std::string& name) const;
  std::vector<exchange::Array> taken(Reply<exchange::GridPacket> reply) const;
  double highest_speed() const;
  void check_node(std::int64_t node) const;

  OutsideProgram program_;
  std::vector<exchange::Array> constants_;  ///< field data that every packet has
  fluid::GridShape shape_;
  double speed_limit_;
  std::int64_t step_ = 0;
  std::vector<double> force_;
  std::vector<exchange::Array> arrays_;  ///< of the last reply: density, velocity, then the program's own
};

}  // namespace tanktread::driver
