#include "fluid/lattice_boltzmann.hpp"

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "fluid/border_checks.hpp"
#include "fluid/collision.hpp"
#include "fluid/developed_flow.hpp"
#include "fluid/end_pack.hpp"
#include "fluid/force_field.hpp"
#include "fluid/node_moments.hpp"
#include "fluid/node_rates.hpp"
#include "fluid/population_lattice.hpp"
#include "fluid/settings.hpp"

namespace tanktread::fluid {
namespace {

using d3q19::n_directions;

class LatticeBoltzmann final : public Fluid {
 public:
  explicit LatticeBoltzmann(const LatticeBoltzmannSettings& settings)
      : settings_(settings),
        n_threads_(settings.threads > 0 ? settings.threads : omp_get_max_threads()),
        lattice_(settings.shape, settings.walls),
        rates_(settings),
        force_(settings.shape, settings.body_force) {
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
      for (std::int64_t k = 0; k < n; ++k) {
        const auto moments = reader.at(nodes[k]);
        std::copy_n(moments.velocity.data(), 3, &velocity[3 * k]);
      }
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
  }

  void clear_force() override {
    force_.clear();
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
    return {lattice_, force_, last_turn(), settings_.inertia};
  }

  template <bool inertia>
  double sweep(Turn turn) {
    const int ny = settings_.shape.ny;
    const std::int64_t n_rows = std::int64_t{ny} * settings_.shape.nz;
    double highest_squared = 0.0;
    std::int64_t first_bad_row = n_rows;
#pragma omp parallel num_threads(n_threads_) reduction(max : highest_squared) reduction(min : first_bad_row)
    {
      RowForce row_force(settings_.shape.nx);
#pragma omp for schedule(static)
      for (std::int64_t row = 0; row < n_rows; ++row) {
        SpeedWatch watch;
        const int y = static_cast<int>(row % ny), z = static_cast<int>(row / ny);
        if (force_.acts_on(row)) {
          force_.gather(row, row_force);
          sweep_row<inertia, true>(turn, y, z, row_force, watch);
        } else {
          sweep_row<inertia, false>(turn, y, z, row_force, watch);
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

  template <bool inertia, bool forced>
  void sweep_row(Turn turn, int y, int z, const RowForce& row_force, SpeedWatch& watch) {
    const int nx = settings_.shape.nx;
    const std::int64_t first_node = settings_.shape.index(0, y, z);
    if (lattice_.walls()) return_from_walls(turn, y, z);
    RowSlots slots;
    for (int i = 0; i < n_directions; ++i) slots[i] = lattice_.row_slot(turn, i, y, z);

    const double limit_squared = settings_.speed_limit * settings_.speed_limit;
    for (int x = 0; x < nx; x += pack_size) {
      const auto force = forced ? row_force.pack(x) : PackForce{};
      if (x + pack_size > nx || (turn == Turn::streaming && (x == 0 || x + pack_size == nx))) {
        collide_end<inertia, forced>(EndPack(lattice_, turn, slots, x, y, z), first_node + x, force, watch);
        continue;
      }
      PackPopulations f;
      for (int i = 0; i < n_directions; ++i) f[i] = load(slots[i] + x);
      collide<inertia, forced>(f, rates_.pack(first_node + x), force, limit_squared, watch,
                               [&](int i, Pack outgoing) { store(slots[i] + x, outgoing); });
    }
  }

  /// Kept out of the loop over whole packs, whose code stays small that way.
  template <bool inertia, bool forced>
  __attribute__((noinline)) void collide_end(const EndPack& end, std::int64_t first_node,
                                             const PackForce& force, SpeedWatch& watch) {
    PackPopulations f;
    end.load_to(f);
    collide<inertia, forced>(f, rates_.end_pack(first_node, end.n_lanes), force,
                             settings_.speed_limit * settings_.speed_limit, watch,
                             [&](int i, Pack outgoing) { end.put(i, outgoing); });
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
              << (std::isfinite(speed) ? "its speed is over the limit of "
                                       : "it must be finite and its speed below ")
              << settings_.speed_limit;
      throw Breakdown(message.str());
    }
    message << "the fluid speed reached the limit of " << settings_.speed_limit << " in row y = " << y
            << ", z = " << z;
    throw Breakdown(message.str());
  }

  LatticeBoltzmannSettings settings_;
  int n_threads_;
  PopulationLattice lattice_;
  NodeRates rates_;
  ForceField force_;
  std::int64_t step_ = 0;
};

}  // namespace

std::unique_ptr<Fluid> make_lattice_boltzmann(const LatticeBoltzmannSettings& settings) {
  check(settings);
  return std::make_unique<LatticeBoltzmann>(settings);
}

}  // namespace tanktread::fluid
