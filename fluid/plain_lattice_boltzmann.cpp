#include "fluid/plain_lattice_boltzmann.hpp"

#include <algorithm>
#include <cmath>

#include "fluid/border_checks.hpp"
#include "fluid/d3q19.hpp"
#include "fluid/developed_flow.hpp"
#include "fluid/settings.hpp"

namespace tanktread::fluid {
namespace {

using d3q19::n_directions;
using Populations = std::array<double, n_directions>;
using Vector = std::array<double, 3>;

double dot(const std::array<int, 3>& c, const Vector& v) {
  return c[0] * v[0] + c[1] * v[1] + c[2] * v[2];
}
double dot(const Vector& a, const Vector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

class PlainLatticeBoltzmann final : public Fluid {
 public:
  explicit PlainLatticeBoltzmann(const LatticeBoltzmannSettings& settings)
      : settings_(settings),
        outgoing_(settings.shape.size()),
        force_(3 * settings.shape.size(), 0.0),
        viscosity_(settings.shape.size(), viscosity_of(settings)) {
    for_each_node([&](int x, int y, int z) {
      outgoing_[shape().index(x, y, z)] = start_populations(settings_, x, y, z);
    });
  }

  GridShape shape() const override { return settings_.shape; }

  void velocity(std::span<const std::int64_t> nodes, std::span<double> velocity) const override {
    check_nodes("velocity()", nodes, velocity.size(), shape().size());
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      const auto u = outgoing_velocity(nodes[k]);
      std::copy(u.begin(), u.end(), &velocity[3 * k]);
    }
  }

  void free_velocity(std::span<const std::int64_t> nodes, std::span<double> velocity,
                     std::span<double> mobility) const override {
    check_nodes("free_velocity()", nodes, velocity.size(), shape().size());
    check_size("free_velocity(): mobility", mobility.size(), static_cast<std::int64_t>(nodes.size()));
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      const auto nx = shape().nx, ny = shape().ny;
      const std::int64_t row = nodes[k] / nx;
      const auto incoming =
          stream(static_cast<int>(nodes[k] % nx), static_cast<int>(row % ny), static_cast<int>(row / ny));
      const auto u = velocity_of(incoming, settings_.body_force, 0.5);
      std::copy(u.begin(), u.end(), &velocity[3 * k]);
      mobility[k] = 0.5 / inertial_density(incoming);
    }
  }

  void moments(std::span<double> density, std::span<double> velocity) const override {
    check_size("moments(): density", density.size(), shape().size());
    check_size("moments(): velocity", velocity.size(), 3 * shape().size());
    for (std::int64_t node = 0; node < shape().size(); ++node) {
      density[node] = 1.0 + density_change(outgoing_[node]);
      const auto u = outgoing_velocity(node);
      std::copy(u.begin(), u.end(), &velocity[3 * node]);
    }
  }

  void dissipation(std::span<double> power) const override {
    check_size("dissipation()", power.size(), shape().size());
    for_each_node([&](int x, int y, int z) {
      const std::int64_t node = shape().index(x, y, z);
      power[node] = dissipation_of(stream(x, y, z), total_force(node), viscosity_[node]);
    });
  }

  void wall_power(std::span<double> power) const override {
    check_size("wall_power()", power.size(), shape().size());
    for_each_node([&](int x, int y, int z) {
      const std::int64_t node = shape().index(x, y, z);
      const Populations incoming = stream(x, y, z), &outgoing = outgoing_[node];
      power[node] = 0.0;
      for (int i = 0; i < n_directions; ++i) {
        const Vector* wall = wall_behind(x, y, z, i);
        if (wall)
          power[node] += dot(d3q19::velocity[i], *wall) * (incoming[i] + outgoing[d3q19::opposite(i)]);
      }
    });
  }

  void add_force(std::span<const std::int64_t> nodes, std::span<const double> force) override {
    check_nodes("add_force()", nodes, force.size(), shape().size());
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      for (int component = 0; component < 3; ++component)
        force_[3 * nodes[k] + component] += force[3 * k + component];
    }
  }

  void clear_force() override { std::fill(force_.begin(), force_.end(), 0.0); }

  std::span<const double> force() const override { return force_; }

  void set_viscosity(std::span<const double> kinematic_viscosity) override {
    check_viscosity(kinematic_viscosity, shape().size());
    viscosity_.assign(kinematic_viscosity.begin(), kinematic_viscosity.end());
  }

  void set_viscosity(std::span<const std::int64_t> nodes,
                     std::span<const double> kinematic_viscosity) override {
    check_viscosity_of_nodes(nodes, kinematic_viscosity, shape().size());
    for (std::size_t k = 0; k < nodes.size(); ++k) viscosity_[nodes[k]] = kinematic_viscosity[k];
  }

  double step() override {
    double highest = 0.0;
    std::vector<Populations> next(outgoing_.size());
    for_each_node([&](int x, int y, int z) {
      const std::int64_t node = shape().index(x, y, z);
      const Populations incoming = stream(x, y, z);
      const Vector force = total_force(node);
      const Vector u = velocity_of(incoming, force, 0.5);
      const double speed = std::sqrt(dot(u, u));
      if (!(speed < settings_.speed_limit)) {
        throw Breakdown("step " + std::to_string(step_ + 1) + ": the fluid speed at node (" +
                        std::to_string(x) + ", " + std::to_string(y) + ", " + std::to_string(z) + ") is " +
                        std::to_string(speed) + ", must be finite and below speed_limit, " +
                            std::to_string(settings_.speed_limit),
                        node);
      }
      highest = std::max(highest, speed);
      next[node] = collide(incoming, u, force, viscosity_[node]);
    });
    outgoing_ = std::move(next);
    ++step_;
    return highest;
  }

  State state() const override {
    State state{step_,
                {{"populations", n_directions, {}}, {"force", 3, force_}, {"viscosity", 1, viscosity_}}};
    for (const auto& populations : outgoing_) {
      state.arrays[0].values.insert(state.arrays[0].values.end(), populations.begin(), populations.end());
    }
    return state;
  }

  void restore(const State& state) override {
    const std::int64_t n = shape().size();
    const auto arrays = check_state(state, n);
    force_.assign(arrays.force.begin(), arrays.force.end());
    viscosity_.assign(n, viscosity_of(settings_));
    if (!arrays.viscosity.empty()) viscosity_.assign(arrays.viscosity.begin(), arrays.viscosity.end());
    for (std::int64_t node = 0; node < n; ++node)
      std::copy_n(&arrays.populations[n_directions * node], n_directions, outgoing_[node].begin());
    step_ = state.step;
  }

 private:
  template <typename Body>
  void for_each_node(Body&& body) const {
    for (int z = 0; z < shape().nz; ++z)
      for (int y = 0; y < shape().ny; ++y)
        for (int x = 0; x < shape().nx; ++x) body(x, y, z);
  }

  Vector total_force(std::int64_t node) const {
    Vector force = settings_.body_force;
    for (int component = 0; component < 3; ++component) force[component] += force_[3 * node + component];
    return force;
  }

  static double density_change(const Populations& f) {
    double sum = 0.0;
    for (const double population : f) sum += population;
    return sum;
  }

  /// rho, or 1 without inertia.
  double inertial_density(const Populations& f) const {
    return settings_.inertia ? 1.0 + density_change(f) : 1.0;
  }

  /// (sum f c + share F)/rho: share 1/2 before the collision, -1/2 after it.
  Vector velocity_of(const Populations& f, const Vector& force, double share) const {
    const double rho = inertial_density(f);
    Vector u{};
    for (int component = 0; component < 3; ++component) {
      for (int i = 0; i < n_directions; ++i) u[component] += d3q19::velocity[i][component] * f[i];
      u[component] = (u[component] + share * force[component]) / rho;
    }
    return u;
  }

  Vector outgoing_velocity(std::int64_t node) const {
    return velocity_of(outgoing_[node], total_force(node), -0.5);
  }

  /// The velocity of the wall from which direction i comes to a node; null: it comes from a node.
  const Vector* wall_behind(int x, int y, int z, int direction) const {
    if (!settings_.walls) return nullptr;
    const int axis = settings_.walls->axis;
    const int source = std::array{x, y, z}[axis] - d3q19::velocity[direction][axis];
    if (source < 0) return &settings_.walls->low_velocity;
    if (source >= std::array{shape().nx, shape().ny, shape().nz}[axis])
      return &settings_.walls->high_velocity;
    return nullptr;
  }

  /// Each population from the neighbour it left, or back from the wall it met half-way.
  Populations stream(int x, int y, int z) const {
    const auto wrapped = [](int position, int n) { return (position + n) % n; };
    Populations incoming{};
    for (int i = 0; i < n_directions; ++i) {
      const auto& c = d3q19::velocity[i];
      if (const Vector* wall = wall_behind(x, y, z, i)) {
        incoming[i] =
            outgoing_[shape().index(x, y, z)][d3q19::opposite(i)] + 6.0 * d3q19::weight(i) * dot(c, *wall);
      } else {
        const auto source = shape().index(wrapped(x - c[0], shape().nx), wrapped(y - c[1], shape().ny),
                                          wrapped(z - c[2], shape().nz));
        incoming[i] = outgoing_[source][i];
      }
    }
    return incoming;
  }

  /// 2 mu S:S, with S = -3/(2 rho tau) [sum_i (f_i - f_i^eq) c_i c_i + (u F + F u)/2].
  double dissipation_of(const Populations& f, const Vector& force, double viscosity) const {
    const double relaxation_time = 0.5 + 3.0 * viscosity;
    const Vector u = velocity_of(f, force, 0.5);
    const double rho = inertial_density(f), quadratic = settings_.inertia ? 1.0 : 0.0;
    double sum = 0.0;
    for (int a = 0; a < 3; ++a) {
      for (int b = 0; b < 3; ++b) {
        double moment = quadratic * 0.5 * (u[a] * force[b] + force[a] * u[b]);
        for (int i = 0; i < n_directions; ++i) {
          const auto& c = d3q19::velocity[i];
          moment += c[a] * c[b] * (f[i] - even_equilibrium(i, density_change(f), rho, u));
        }
        const double strain_rate = -1.5 / (rho * relaxation_time) * moment;
        sum += strain_rate * strain_rate;
      }
    }
    return 2.0 * rho * viscosity * sum;
  }

  double even_equilibrium(int direction, double change, double rho, const Vector& u) const {
    const double quadratic = settings_.inertia ? rho : 0.0, cu = dot(d3q19::velocity[direction], u);
    return d3q19::weight(direction) * (change + quadratic * (4.5 * cu * cu - 1.5 * dot(u, u)));
  }

  Populations collide(const Populations& f, const Vector& u, const Vector& force, double viscosity) const {
    const double relaxation_time = 0.5 + 3.0 * viscosity;
    const double even_rate = 1.0 / relaxation_time;
    const double odd_rate = 1.0 / odd_relaxation_time(settings_, relaxation_time);
    const double change = density_change(f);
    const double rho = inertial_density(f);
    const double quadratic = settings_.inertia ? 1.0 : 0.0;
    Populations out{};
    for (int i = 0; i < n_directions; ++i) {
      const auto& c = d3q19::velocity[i];
      const double w = d3q19::weight(i), back = f[d3q19::opposite(i)];
      const double cu = dot(c, u), cF = dot(c, force);
      const double odd_equilibrium = w * 3.0 * rho * cu;
      const double even_force = w * quadratic * (9.0 * cu * cF - 3.0 * dot(u, force));
      const double odd_force = w * 3.0 * cF;
      out[i] = f[i] - even_rate * (0.5 * (f[i] + back) - even_equilibrium(i, change, rho, u)) -
               odd_rate * (0.5 * (f[i] - back) - odd_equilibrium) + (1.0 - 0.5 * even_rate) * even_force +
               (1.0 - 0.5 * odd_rate) * odd_force;
    }
    return out;
  }

  LatticeBoltzmannSettings settings_;
  std::vector<Populations> outgoing_;  ///< populations less weights, after the last collision
  std::vector<double> force_, viscosity_;
  std::int64_t step_ = 0;
};

}  // namespace

std::unique_ptr<Fluid> make_plain_lattice_boltzmann(const LatticeBoltzmannSettings& settings) {
  check(settings);
  return std::make_unique<PlainLatticeBoltzmann>(settings);
}

}  // namespace tanktread::fluid
