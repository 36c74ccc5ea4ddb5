#include "fluid/lattice_boltzmann.hpp"

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "fluid/border_checks.hpp"
#include "fluid/collision.hpp"
#include "fluid/developed_flow.hpp"
#include "fluid/force_field.hpp"
#include "fluid/kept_velocity.hpp"
#include "fluid/node_moments.hpp"
#include "fluid/node_rates.hpp"
#include "fluid/population_lattice.hpp"
#include "fluid/row_packs.hpp"
#include "fluid/settings.hpp"

namespace tanktread::fluid {
namespace {

using d3q19::n_directions;

class LatticeBoltzmann final : public Fluid {
 public:
  explicit LatticeBoltzmann(const LatticeBoltzmannSettings& settings)
      : settings_(settings),
        limit_squared_(settings.speed_limit * settings.speed_limit),
        n_threads_(settings.threads > 0 ? settings.threads : omp_get_max_threads()),
        lattice_(settings.shape, settings.walls),
        rates_(settings),
        force_(settings.shape, settings.body_force),
        kept_velocity_(settings.shape) {
    for_each_row([&](int y, int z) {
      for (int x = 0; x < shape().nx; ++x)
        lattice_.put_outgoing(last_turn(), x, y, z, start_populations(settings_, x, y, z).data());
    });
  }

  GridShape shape() const override { return settings_.shape; }

  void velocity(std::span<const std::int64_t> nodes, std::span<double> velocity) const override {
    check_nodes("velocity()", nodes, velocity.size(), shape().size());
    const std::int64_t n = static_cast<std::int64_t>(nodes.size());
#pragma omp parallel num_threads(n_threads_)
    {
      MomentReader reader = moment_reader();
#pragma omp for schedule(static)
      for (std::int64_t k = 0; k < n; ++k) reader.velocity_at(nodes[k], &velocity[3 * k]);
    }
  }

  void moments(std::span<double> density, std::span<double> velocity) const override {
    const std::int64_t n = shape().size();
    check_size("moments(): density", density.size(), n);
    check_size("moments(): velocity", velocity.size(), 3 * n);
#pragma omp parallel num_threads(n_threads_)
    {
      MomentReader reader = moment_reader();
#pragma omp for schedule(static)
      for (std::int64_t node = 0; node < n; ++node) {
        const auto at_node = reader.at(node);
        density[node] = at_node.density;
        std::copy_n(at_node.velocity.data(), 3, &velocity[3 * node]);
      }
    }
  }

  void add_force(std::span<const std::int64_t> nodes, std::span<const double> force) override {
    check_nodes("add_force()", nodes, force.size(), shape().size());
    force_.add(nodes, force);
    kept_velocity_.forget();  // velocity() is that under the present force
  }

  void clear_force() override {
    force_.clear();
    kept_velocity_.forget();
  }

  std::span<const double> force() const override {
    return force_.added();
  }

  void set_viscosity(std::span<const double> kinematic_viscosity) override {
    check_viscosity(kinematic_viscosity, shape().size());
    rates_.set_viscosity(kinematic_viscosity);
  }

  double step() override {
    const Turn turn = next_turn();
    kept_velocity_.forget();
    const double highest_squared = settings_.inertia ? sweep<true>(turn) : sweep<false>(turn);
    ++step_;
    return std::sqrt(highest_squared);
  }

  State state() const override {
    State state;
    state.step = step_;
    state.arrays.push_back({"populations", n_directions, std::vector<double>(n_directions * shape().size())});
    state.arrays.push_back({"force", 3, force_.added()});
    if (!rates_.viscosity().empty()) state.arrays.push_back({"viscosity", 1, rates_.viscosity()});
    auto& values = state.arrays[0].values;
    for_each_row([&](int y, int z) {
      for (int x = 0; x < shape().nx; ++x)
        lattice_.get_outgoing(last_turn(), x, y, z, &values[n_directions * shape().index(x, y, z)]);
    });
    return state;
  }

  void restore(const State& state) override {
    const auto arrays = check_state(state, shape().size());
    step_ = state.step;
    force_.restore(arrays.force);
    kept_velocity_.forget();
    rates_.set_viscosity(arrays.viscosity);
    for_each_row([&](int y, int z) {
      for (int x = 0; x < shape().nx; ++x)
        lattice_.put_outgoing(last_turn(), x, y, z,
                              &arrays.populations[n_directions * shape().index(x, y, z)]);
    });
  }

 private:
  Turn next_turn() const {
    return step_ % 2 == 0 ? Turn::streaming : Turn::local;
  }
  Turn last_turn() const {
    return step_ % 2 == 0 ? Turn::local : Turn::streaming;
  }

  template <typename Body>
  void for_each_row(Body&& body) const {
    const int ny = settings_.shape.ny;
    const std::int64_t n_rows = std::int64_t{ny} * settings_.shape.nz;
#pragma omp parallel for num_threads(n_threads_) schedule(static)
    for (std::int64_t row = 0; row < n_rows; ++row)
      body(static_cast<int>(row % ny), static_cast<int>(row / ny));
  }

  MomentReader moment_reader() const {
    return {lattice_, force_, kept_velocity_, last_turn(), settings_.inertia};
  }

  template <bool inertia>
  double sweep(Turn turn) {
    const int ny = settings_.shape.ny;
    const std::int64_t n_rows = std::int64_t{ny} * settings_.shape.nz;
    double highest_squared = 0.0;
    std::int64_t first_bad_row = n_rows;
#pragma omp parallel num_threads(n_threads_) reduction(max : highest_squared) reduction(min : first_bad_row)
    {
#pragma omp for schedule(static)
      for (std::int64_t row = 0; row < n_rows; ++row) {
        SpeedWatch watch;
        const int y = static_cast<int>(row % ny), z = static_cast<int>(row / ny);
        if (force_.may_act_in(row)) {
          sweep_row<inertia, true>(turn, y, z, watch);
        } else {
          sweep_row<inertia, false>(turn, y, z, watch);
        }
        for (int lane = 0; lane < pack_size; ++lane) {
          highest_squared = std::max(highest_squared, watch.highest_squared[lane]);
          if (watch.n_bad[lane] != 0.0) first_bad_row = std::min(first_bad_row, row);
        }
      }
    }
    if (first_bad_row < n_rows) report_breakdown(first_bad_row);
    return highest_squared;
  }

  /// @tparam may_have_force forces are looked for, pack by pack
  template <bool inertia, bool may_have_force>
  void sweep_row(Turn turn, int y, int z, SpeedWatch& watch) {
    const int nx = settings_.shape.nx;
    const std::int64_t row = std::int64_t{z} * settings_.shape.ny + y;
    if (lattice_.walls()) return_from_walls(turn, y, z);
    RowSlots slots;
    for (int i = 0; i < n_directions; ++i) slots[i] = lattice_.row_slot(turn, i, y, z);

    for (int x = 0; x < nx; x += pack_size) {
      const bool at_end = x + pack_size > nx || (turn == Turn::streaming && (x == 0 || x + pack_size == nx));
      if constexpr (may_have_force) {
        const bool added = force_.added_to(row, x, std::min(pack_size, nx - x));
        if (added || force_.has_body_force()) {
          if (at_end)
            push<inertia>(EndPack(lattice_, turn, slots, x, y, z), row, x, added, watch);
          else
            push<inertia>(WholePack{slots, x}, row, x, added, watch);
          continue;
        }
      }
      if (at_end)
        collide_end<inertia>(EndPack(lattice_, turn, slots, x, y, z), row, x, watch);
      else
        collide_at<inertia, false>(WholePack{slots, x}, row, x, PackForce{}, watch);
    }
  }

  // Two kinds of pack are kept out of the loop over whole packs without a force, whose code stays small that
  // way.

  template <bool inertia>
  __attribute__((noinline)) void collide_end(const EndPack& at, std::int64_t row, int x, SpeedWatch& watch) {
    collide_at<inertia, false>(at, row, x, PackForce{}, watch);
  }

  /// Collides a pack with a force, and keeps its velocity if the force was added.
  template <bool inertia, typename SomePack>
  __attribute__((noinline)) void push(const SomePack& at, std::int64_t row, int x, bool added,
                                      SpeedWatch& watch) {
    const PackForce force = added ? force_.total(row, x, at.n_lanes()) : force_.body_force();
    collide_at<inertia, true>(at, row, x, force, watch);
    if (!added) return;
    PackPopulations outgoing;
    at.load_outgoing(outgoing);
    kept_velocity_.put(row, x,
                       outgoing_moments<Pack>(outgoing, {force.x, force.y, force.z}, inertia).velocity);
  }

  template <bool inertia, bool forced, typename SomePack>
  __attribute__((always_inline)) void collide_at(const SomePack& at, std::int64_t row, int x,
                                                 const PackForce& force, SpeedWatch& watch) {
    PackPopulations f;
    at.load_to(f);
    collide<inertia, forced>(f, rates_.pack(row * settings_.shape.nx + x, at.n_lanes()), force,
                             limit_squared_, watch, [&](int i, Pack outgoing) { at.put(i, outgoing); });
  }

  /// What moving walls give to the populations they send back, added where the step will find these.
  void return_from_walls(Turn turn, int y, int z) {
    const int nx = settings_.shape.nx;
    const bool across_rows = lattice_.walls()->axis == 0;
    for (int i = 1; i < n_directions; ++i) {
      const double gain = lattice_.wall_gain(i);
      if (gain == 0.0) continue;
      if (across_rows) {
        for (const int x : {0, nx - 1}) {
          if (lattice_.from_wall(i, x, y, z)) *lattice_.slot(turn, i, x, y, z) += gain;
        }
      } else if (lattice_.from_wall(i, 0, y, z)) {
        double* slots = lattice_.row(i, y, z);
        for (int x = 0; x < nx; ++x) slots[x] += gain;
      }
    }
  }

  /// Looks for the node that broke down in a row the step has just written.
  [[noreturn]] void report_breakdown(std::int64_t row) {
    ++step_;
    const int ny = settings_.shape.ny;
    const int y = static_cast<int>(row % ny), z = static_cast<int>(row / ny);
    std::ostringstream message;
    message << "step " << step_ << ": ";
    MomentReader reader = moment_reader();
    for (int x = 0; x < settings_.shape.nx; ++x) {
      const auto moments = reader.at(settings_.shape.index(x, y, z));
      const auto& u = moments.velocity;
      const double speed = std::sqrt(u[0] * u[0] + u[1] * u[1] + u[2] * u[2]);
      if (speed < settings_.speed_limit) continue;
      message << "the fluid velocity at node (" << x << ", " << y << ", " << z << ") is (" << u[0] << ", "
              << u[1] << ", " << u[2] << "), density " << moments.density << "; "
              << (std::isfinite(speed) ? "its speed is over speed_limit, "
                                       : "it must be finite and its speed below speed_limit, ")
              << settings_.speed_limit;
      throw Breakdown(message.str());
    }
    message << "the fluid speed reached speed_limit, " << settings_.speed_limit << " in row y = " << y
            << ", z = " << z;
    throw Breakdown(message.str());
  }

  LatticeBoltzmannSettings settings_;
  double limit_squared_;  ///< of the speed
  int n_threads_;
  PopulationLattice lattice_;
  NodeRates rates_;
  ForceField force_;
  KeptVelocity kept_velocity_;
  std::int64_t step_ = 0;
};

}  // namespace

std::unique_ptr<Fluid> make_lattice_boltzmann(const LatticeBoltzmannSettings& settings) {
  check(settings);
  return std::make_unique<LatticeBoltzmann>(settings);
}

}  // namespace tanktread::fluid
