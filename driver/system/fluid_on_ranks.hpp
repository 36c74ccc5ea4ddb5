// The flow solver of a box that several ranks share, as one solver.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <vector>

#include "driver/system/node_shares.hpp"
#include "fluid/lattice_boltzmann.hpp"
#include "ranks/division.hpp"
#include "ranks/world.hpp"

namespace tanktread::driver {

/// The first rank leads: it has this solver, which looks like one of the whole box. The other ranks have
/// their parts, in follow(), and do what they are told. Each part is advanced by its own rank, all at once;
/// what crosses the cuts goes from neighbour to neighbour (HaloByRanks). Results are those of one rank, to
/// the last bit. One at a time.
class FluidOnRanks final : public fluid::Fluid {
 public:
  /// World is borrowed. @throws std::invalid_argument as fluid::make_lattice_boltzmann
  FluidOnRanks(const ranks::World& world, const ranks::Division& division,
               const fluid::LatticeBoltzmannSettings& settings);
  /// The others let go of their parts.
  ~FluidOnRanks() override;

  /// The first rank's part.
  fluid::Fluid& own_part() { return *own_; }
  const ranks::World& world() const { return world_; }
  const ranks::Division& division() const { return division_; }
  /// Of nodes that have none of their own.
  double base_viscosity() const { return base_viscosity_; }

  fluid::GridShape shape() const override { return shape_; }
  void velocity(std::span<const std::int64_t> nodes, std::span<double> velocity) const override;
  void free_velocity(std::span<const std::int64_t> nodes, std::span<double> velocity,
                     std::span<double> mobility) const override;
  void dissipation(std::span<double> power) const override;
  void wall_power(std::span<double> power) const override;
  void moments(std::span<double> density, std::span<double> velocity) const override;
  void moments_of_layers(fluid::Layers layers, std::span<double> density,
                         std::span<double> velocity) const override;
  void add_force(std::span<const std::int64_t> nodes, std::span<const double> force) override;
  void clear_force() override;
  /// Gathered when it is asked for.
  std::span<const double> force() const override;
  void set_viscosity(std::span<const double> kinematic_viscosity) override;
  void set_viscosity(std::span<const std::int64_t> nodes,
                     std::span<const double> kinematic_viscosity) override;
  /// @throws fluid::Breakdown that one rank would have thrown: of the first node in the order of the box
  double step() override;
  fluid::State state() const override;
  void restore(const fluid::State& state) override;
  /// Takes over a state in pieces (fluid_pieces.hpp), however they are cut: each rank reads its own block.
  /// @throws exchange::FileError; std::invalid_argument as restore(), of the first rank that has an error
  void restore_pieces(const std::filesystem::path& index);

 private:
  /// Tells the others which nodes are meant, if they are not those of before.
  const std::vector<NodeShare>& shares_of(std::span<const std::int64_t> nodes) const;
  std::vector<double> answer_of(int rank) const;
  void gather(std::span<const double> own, int components, std::span<double> of_box) const;
  void add_part(const fluid::State& part, int rank, fluid::State& state) const;

  const ranks::World& world_;
  ranks::Division division_;
  fluid::GridShape shape_;
  double base_viscosity_;              ///< of nodes that have none of their own
  std::unique_ptr<fluid::Fluid> own_;  ///< the first rank's part
  mutable NodeShares asked_;           ///< of velocities and forces, whose nodes are mostly those of before
  NodeShares changed_;                 ///< of viscosities
  mutable std::vector<double> force_;
};

}  // namespace tanktread::driver
