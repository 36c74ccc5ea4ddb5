#include "fluid/lattice_boltzmann.hpp"

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "fluid/border_checks.hpp"
#include "fluid/breakdown_report.hpp"
#include "fluid/developed_flow.hpp"
#include "fluid/force_field.hpp"
#include "fluid/incoming_moments.hpp"
#include "fluid/kept_velocity.hpp"
#include "fluid/lattice_state.hpp"
#include "fluid/node_dissipation.hpp"
#include "fluid/node_moments.hpp"
#include "fluid/node_rates.hpp"
#include "fluid/part_rows.hpp"
#include "fluid/population_halo.hpp"
#include "fluid/population_lattice.hpp"
#include "fluid/row_sweep.hpp"
#include "fluid/settings.hpp"
#include "fluid/wall_links.hpp"

namespace tanktread::fluid {
namespace {

using d3q19::n_directions;

/// @tparam Real of the populations, and of the arithmetic of a step
template <typename Real>
class LatticeBoltzmann final : public Fluid {
 public:
  /// @param exchange none if the part is the whole box
  LatticeBoltzmann(const LatticeBoltzmannSettings& settings, const GridPart& part,
                   std::unique_ptr<HaloExchange> exchange)
      : settings_(settings),
        part_(part),
        limit_squared_(static_cast<Real>(settings.speed_limit * settings.speed_limit)),
        n_threads_(settings.threads > 0 ? settings.threads : omp_get_max_threads()),
        lattice_(settings.shape, settings.walls, part),
        exchange_(std::move(exchange)),
        rates_(settings, part.shape),
        force_(part.shape, settings.body_force, n_threads_),
        kept_velocity_(part.shape) {
    if (exchange_) halo_.emplace(lattice_, *exchange_);
    rows_ = rows_of(lattice_);
    for_each_row([&](int y, int z) {
      for (int x = 0; x < shape().nx; ++x)
        put_outgoing(
            lattice_, last_turn(), x, y, z,
            start_populations(settings_, part_.begin[0] + x, part_.begin[1] + y, part_.begin[2] + z).data());
    });
    if (halo_) halo_->send(last_turn());
  }

  GridShape shape() const override { return part_.shape; }

  void velocity(std::span<const std::int64_t> nodes, std::span<double> velocity) const override {
    check_nodes("velocity()", nodes, velocity.size(), shape().size(), n_threads_);
    const std::int64_t n = static_cast<std::int64_t>(nodes.size());
#pragma omp parallel num_threads(n_threads_)
    {
      auto reader = moment_reader();
#pragma omp for schedule(static)
      for (std::int64_t k = 0; k < n; ++k) reader.velocity_at(nodes[k], &velocity[3 * k]);
    }
  }

  void free_velocity(std::span<const std::int64_t> nodes, std::span<double> velocity,
                     std::span<double> mobility) const override {
    check_nodes("free_velocity()", nodes, velocity.size(), shape().size(), n_threads_);
    const std::int64_t n = static_cast<std::int64_t>(nodes.size());
    check_size("free_velocity(): mobility", mobility.size(), n);
    receive();
#pragma omp parallel num_threads(n_threads_)
    {
      IncomingReader<Real> reader(lattice_, force_, next_turn(), settings_.inertia);
#pragma omp for schedule(static)
      for (std::int64_t k = 0; k < n; ++k) reader.read(nodes[k], &velocity[3 * k], &mobility[k]);
    }
  }

  void moments(std::span<double> density, std::span<double> velocity) const override {
    moments_of_layers({0, shape().nz}, density, velocity);
  }

  void moments_of_layers(Layers layers, std::span<double> density,
                         std::span<double> velocity) const override {
    const std::int64_t n = check_layers("moments()", layers, shape());
    check_size("moments(): density", density.size(), n);
    check_size("moments(): velocity", velocity.size(), 3 * n);
    const std::int64_t first = shape().index(0, 0, layers.begin);
#pragma omp parallel num_threads(n_threads_)
    {
      auto reader = moment_reader();
#pragma omp for schedule(static)
      for (std::int64_t k = 0; k < n; ++k) {
        const auto at_node = reader.at(first + k);
        density[k] = at_node.density;
        std::copy_n(at_node.velocity.data(), 3, &velocity[3 * k]);
      }
    }
  }

  void dissipation(std::span<double> power) const override {
    check_size("dissipation()", power.size(), shape().size());
    const std::int64_t nx = shape().nx, n_rows = std::int64_t{shape().ny} * shape().nz;
    receive();
#pragma omp parallel num_threads(n_threads_)
    {
      IncomingPacks<Real> packs(lattice_, next_turn());
#pragma omp for schedule(static)
      for (std::int64_t row = 0; row < n_rows; ++row) {
        for (int x = 0; x < nx; x += pack_size<Real>)
          dissipation_of_pack(packs, row, x, power.subspan(row * nx, nx));
      }
    }
  }

  void wall_power(std::span<double> power) const override {
    check_size("wall_power()", power.size(), shape().size());
    std::ranges::fill(power, 0.0);
    if (!lattice_.walls()) return;
    for_each_wall_node(shape(), lattice_.walls()->axis, [&](int x, int y, int z) {
      double outgoing[n_directions];
      get_outgoing(lattice_, last_turn(), x, y, z, outgoing);
      double& of_node = power[shape().index(x, y, z)];
      for (int i = 1; i < n_directions; ++i)
        if (lattice_.from_wall(i, x, y, z))
          of_node += power_of_link(i, outgoing[d3q19::opposite(i)], lattice_.wall_gain(i));
    });
  }

  void add_force(std::span<const std::int64_t> nodes, std::span<const double> force) override {
    check_nodes("add_force()", nodes, force.size(), shape().size(), n_threads_);
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
    rates_.set_all(kinematic_viscosity);
  }

  void set_viscosity(std::span<const std::int64_t> nodes,
                     std::span<const double> kinematic_viscosity) override {
    check_viscosity_of_nodes(nodes, kinematic_viscosity, shape().size());
    rates_.set(nodes, kinematic_viscosity);
  }

  double step() override {
    const Turn turn = next_turn();
    kept_velocity_.forget();
    const double highest_squared = settings_.inertia ? sweep<true>(turn) : sweep<false>(turn);
    ++step_;
    if (halo_) halo_->send(last_turn());
    return std::sqrt(highest_squared);
  }

  State state() const override {
    State state{step_, {}};
    for (const auto& [name, components] : parts_.arrays()) {
      state.arrays.push_back({name, components, {}});
      auto& values = state.arrays.back().values;
      values.resize(static_cast<std::size_t>(components * shape().size()));
      state_of_layers(name, {0, shape().nz}, values);
    }
    return state;
  }

  StateShape state_shape() const override {
    return {step_, parts_.arrays()};
  }

  void state_of_layers(const std::string& array, Layers layers, std::span<double> values) const override {
    parts_.get(array, layers, last_turn(), values);
  }

  void restore(const State& state) override {
    check_state(state, shape().size());
    restore_from(StateInMemory(state, shape()));
  }

  void restore_from(const StateSource& state) override {
    const auto its_shape = state.shape();
    parts_.check(state, its_shape);
    state.accepted();
    if (parts_.has_viscosity(its_shape)) {
      rates_.begin_set_all();  // first: it may find no memory
    } else {
      rates_.set_all({});
    }
    receive();  // what is under way is of the state before
    step_ = its_shape.step;
    kept_velocity_.forget();
    try {
      parts_.put(state, its_shape, last_turn());
    } catch (...) {  // of the source; the neighbours, who know nothing of it, need not wait for nobody
      if (halo_) halo_->send(last_turn());
      throw;
    }
    if (halo_) halo_->send(last_turn());
  }

 private:
  /// What comes in at the border of a part is in its place after this.
  void receive() const {
    if (halo_) halo_->receive();
  }

  Turn next_turn() const {
    return step_ % 2 == 0 ? Turn::streaming : Turn::local;
  }
  Turn last_turn() const {
    return step_ % 2 == 0 ? Turn::local : Turn::streaming;
  }

  template <typename Body>
  void for_each_row(Body&& body) const {
    const int ny = shape().ny;
    const std::int64_t n_rows = std::int64_t{ny} * shape().nz;
#pragma omp parallel for num_threads(n_threads_) schedule(static)
    for (std::int64_t row = 0; row < n_rows; ++row)
      body(static_cast<int>(row % ny), static_cast<int>(row / ny));
  }

  /// @param of_row of the nodes of the row
  void dissipation_of_pack(IncomingPacks<Real>& packs, std::int64_t row, int x,
                           std::span<double> of_row) const {
    PackPopulations<Real> incoming;
    packs.load(row, x, incoming);
    const Rates<Real> rates = rates_.pack(row, x);
    const int n_lanes = std::min(pack_size<Real>, shape().nx - x);
    for (int lane = 0; lane < n_lanes; ++lane) {
      std::array<double, n_directions> f;
      for (int i = 0; i < n_directions; ++i) f[i] = incoming[i][lane];
      of_row[x + lane] = dissipation_of_node(f, force_.total(row * shape().nx + x + lane), rates.even[lane],
                                             settings_.inertia);
    }
  }

  MomentReader<Real> moment_reader() const {
    return {lattice_, force_, kept_velocity_, last_turn(), settings_.inertia};
  }

  /// What the rows of a sweep have met.
  struct Met {
    double highest_squared = 0.0;  ///< of the speed
    std::int64_t first_bad_row;    ///< the number of rows if there is none
  };

  template <bool inertia>
  double sweep(Turn turn) {
    const RowSweep<Real, inertia> sweep(
        SweepParts<Real>{lattice_, rates_, force_, kept_velocity_, limit_squared_}, turn);
    Met met{0.0, shape().size() / shape().nx};
    const std::int64_t none = met.first_bad_row;
    advance(sweep, rows_.inner, met);
    receive();  // while these rows went on, it came
    advance(sweep, rows_.at_cuts, met);
    if (met.first_bad_row < none) break_down(met.first_bad_row);
    return met.highest_squared;
  }

  template <bool inertia>
  void advance(const RowSweep<Real, inertia>& sweep, const std::vector<std::int64_t>& rows, Met& met) {
    if (rows.empty()) return;
    const int ny = shape().ny;
    const auto n_rows = static_cast<std::int64_t>(rows.size());
    double highest_squared = met.highest_squared;
    std::int64_t first_bad_row = met.first_bad_row;
#pragma omp parallel num_threads(n_threads_) reduction(max : highest_squared) reduction(min : first_bad_row)
    {
      SpeedWatch<Real> watch;
#pragma omp for schedule(static)
      for (std::int64_t k = 0; k < n_rows; ++k) {
        const std::int64_t row = rows[k];
        watch.n_bad = Pack<Real>{};
        sweep.advance(static_cast<int>(row % ny), static_cast<int>(row / ny), watch);
        if (any_lane(watch.n_bad)) first_bad_row = std::min(first_bad_row, row);
      }
      for (int lane = 0; lane < pack_size<Real>; ++lane)
        highest_squared = std::max<double>(highest_squared, watch.highest_squared[lane]);
    }
    met = {highest_squared, first_bad_row};
  }

  /// Ends a step that broke down in a row. The part has sent all the same, so that its neighbours, who know
  /// nothing of it, need not be waited for by nobody.
  [[noreturn]] void break_down(std::int64_t row) {
    ++step_;
    if (halo_) halo_->send(last_turn());
    auto reader = moment_reader();
    throw_breakdown(reader, settings_, part_, step_, row);
  }

  LatticeBoltzmannSettings settings_;
  GridPart part_;
  Real limit_squared_;  ///< of the speed
  int n_threads_;
  PopulationLattice<Real> lattice_;
  /// Of a part only. What comes from others may be received when it is asked for: nothing outside can tell.
  mutable std::optional<PopulationHalo<Real>> halo_;
  std::unique_ptr<HaloExchange> exchange_;  ///< goes before the memory of its messages
  PartRows rows_;
  NodeRates<Real> rates_;
  ForceField force_;
  KeptVelocity<Real> kept_velocity_;
  LatticeState<Real> parts_{lattice_, rates_, force_, n_threads_};
  std::int64_t step_ = 0;
};

}  // namespace

std::unique_ptr<Fluid> make_lattice_boltzmann(const LatticeBoltzmannSettings& settings) {
  return make_lattice_boltzmann(settings, GridPart{{0, 0, 0}, settings.shape}, nullptr);
}

std::unique_ptr<Fluid> make_lattice_boltzmann(const LatticeBoltzmannSettings& settings, const GridPart& part,
                                              std::unique_ptr<HaloExchange> exchange) {
  check(settings);
  check(part, settings.shape);
  const bool is_whole = part.shape == settings.shape;
  if (is_whole == (exchange != nullptr))
    refuse(is_whole ? "a part that is the whole box has nothing to exchange"
                    : "a part of a box needs an exchange with the others");
  if (settings.storage == Storage::single_precision)
    return std::make_unique<LatticeBoltzmann<float>>(settings, part, std::move(exchange));
  return std::make_unique<LatticeBoltzmann<double>>(settings, part, std::move(exchange));
}

}  // namespace tanktread::fluid
