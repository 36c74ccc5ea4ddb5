#include "driver/system/implicit_forces.hpp"

#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "driver/system/node_ranges.hpp"
#include "driver/system/node_spans.hpp"

namespace tanktread::driver {
namespace {

/// That of a process that has all of the grid nodes.
class WholeMobility final : public NodeMobility {
 public:
  /// All is borrowed. @param free velocity and mobility of each grid node that the stencils touch
  WholeMobility(const std::vector<CapsuleMembrane>& membranes, const coupler::Coupler& coupler,
                const NodeCorrections& corrections, const GridVectors& free, int threads)
      : coupler_(coupler),
        corrections_(corrections),
        free_(free),
        n_threads_(threads),
        on_grid_(free.values.size()) {
    if (!corrections.along_membrane) return;
    std::vector<std::span<const double>> positions;
    std::vector<std::span<const int>> triangles;
    for (const auto& membrane : membranes) {
      positions.push_back(numbers_of(membrane.positions()));
      triangles.push_back(numbers_of(membrane.reference().triangles));
    }
    normals_ = corrections.normals->find(positions, triangles);
  }

  void velocity_of(const NodeVectors& force, bool with_free, NodeVectors& velocity) override {
    const auto forces = views(force);
    const auto targets = targets_of(velocity);
    coupler_.spread(forces, on_grid_);
    move_freely(free_, with_free, n_threads_, on_grid_);
    coupler_.interpolate(on_grid_, targets);
    if (corrections_.along_membrane) corrections_.along_membrane->add(coupler_, normals_, forces, targets);
  }

  double sum(std::span<const double> of_membranes) const override {
    double sum = 0;
    for (const double number : of_membranes) sum += number;
    return sum;
  }

 private:
  const coupler::Coupler& coupler_;
  const NodeCorrections& corrections_;
  const GridVectors& free_;
  int n_threads_;
  std::span<const std::span<const double>> normals_;
  std::vector<double> on_grid_;
};

/// The numbers of the stresses of all membranes, one membrane after the other, and the matrix of their
/// equations.
class Equations {
 public:
  /// Both are borrowed.
  Equations(std::vector<CapsuleMembrane>& membranes, NodeMobility& mobility)
      : membranes_(membranes), mobility_(mobility) {
    for (const auto& membrane : membranes) {
      const auto* viscosity = membrane.implicit_viscosity();
      first_.push_back(n_numbers_);
      if (viscosity != nullptr) n_numbers_ += 3 * viscosity->rates().n_rates();
      force_.emplace_back(Eigen::Matrix3Xd::Zero(3, membrane.n_nodes()));
    }
    first_.push_back(n_numbers_);
    velocity_ = zero_like(force_);
  }

  /// The scalar product, a sum of membranes: each adds its own first, so that it does not matter who has it.
  double dot(const Eigen::VectorXd& left, const Eigen::VectorXd& right) const {
    std::vector<double> of_membranes;
    for (std::size_t k = 0; k < membranes_.size(); ++k) {
      const auto n = first_[k + 1] - first_[k];
      of_membranes.push_back(left.segment(first_[k], n).dot(right.segment(first_[k], n)));
    }
    return mobility_.sum(of_membranes);
  }
  double norm(const Eigen::VectorXd& numbers) const { return std::sqrt(dot(numbers, numbers)); }

  /// 2 s(t) - s(t-1).
  Eigen::VectorXd guess() const {
    Eigen::VectorXd numbers(n_numbers_);
    for_each([&](std::size_t k, const auto& viscosity) { part(numbers, k, viscosity) = viscosity.guess(); });
    return numbers;
  }

  /// theta s(t).
  Eigen::VectorXd memory() const {
    Eigen::VectorXd numbers = Eigen::VectorXd::Zero(n_numbers_);
    for_each(
        [&](std::size_t k, const auto& viscosity) { viscosity.add_memory(part(numbers, k, viscosity)); });
    return numbers;
  }

  /// B u, u that which the fluid will have if the nodal forces are F0 - B^T s.
  /// @param force F0
  Eigen::VectorXd rates_under(const Eigen::VectorXd& stress, const NodeVectors& force) const {
    forces_of(stress);
    for (std::size_t k = 0; k < force.size(); ++k) force_[k] = force[k] - force_[k];
    mobility_.velocity_of(force_, true, velocity_);
    Eigen::VectorXd numbers(n_numbers_);
    for_each([&](std::size_t k, const auto& viscosity) {
      viscosity.rates().multiply(velocity_[k], part(numbers, k, viscosity));
    });
    return numbers;
  }

  /// (1 + theta) s.
  Eigen::VectorXd diagonal(const Eigen::VectorXd& stress) const {
    Eigen::VectorXd numbers = Eigen::VectorXd::Zero(n_numbers_);
    for_each([&](std::size_t k, const auto& viscosity) {
      viscosity.add_diagonal(part(stress, k, viscosity), part(numbers, k, viscosity));
    });
    return numbers;
  }

  /// (1 + theta + B M B^T) s.
  Eigen::VectorXd product(const Eigen::VectorXd& stress) const {
    mobility_.velocity_of(forces_of(stress), false, velocity_);
    Eigen::VectorXd numbers(n_numbers_);
    for_each([&](std::size_t k, const auto& viscosity) {
      auto of_membrane = part(numbers, k, viscosity);
      viscosity.rates().multiply(velocity_[k], of_membrane);
      viscosity.add_diagonal(part(stress, k, viscosity), of_membrane);
    });
    return numbers;
  }

  /// B^T s of every membrane, zero for those without an implicit viscosity. Valid until the next call of any.
  const NodeVectors& forces_of(const Eigen::VectorXd& stress) const {
    for (std::size_t k = 0; k < membranes_.size(); ++k) {
      const auto* viscosity = std::as_const(membranes_[k]).implicit_viscosity();
      if (viscosity == nullptr) {
        force_[k].setZero();
      } else {
        viscosity->rates().multiply_transposed(part(stress, k, *viscosity), force_[k]);
      }
    }
    return force_;
  }

  void accept(const Eigen::VectorXd& stress) {
    for (std::size_t k = 0; k < membranes_.size(); ++k) {
      auto* viscosity = membranes_[k].implicit_viscosity();
      if (viscosity != nullptr) viscosity->accept(part(stress, k, *viscosity));
    }
  }

 private:
  template <class Work>
  void for_each(const Work& work) const {
    for (std::size_t k = 0; k < membranes_.size(); ++k) {
      const membrane::ImplicitViscosity* viscosity = std::as_const(membranes_[k]).implicit_viscosity();
      if (viscosity != nullptr) work(k, *viscosity);
    }
  }

  Eigen::Map<Eigen::Matrix3Xd> part(Eigen::VectorXd& numbers, std::size_t k,
                                    const membrane::ImplicitViscosity& viscosity) const {
    return {numbers.data() + first_[k], 3, viscosity.rates().n_rates()};
  }
  Eigen::Map<const Eigen::Matrix3Xd> part(const Eigen::VectorXd& numbers, std::size_t k,
                                          const membrane::ImplicitViscosity& viscosity) const {
    return {numbers.data() + first_[k], 3, viscosity.rates().n_rates()};
  }

  std::vector<CapsuleMembrane>& membranes_;
  NodeMobility& mobility_;
  std::vector<Eigen::Index> first_;  ///< number of each membrane; at the end, of all
  Eigen::Index n_numbers_ = 0;
  mutable NodeVectors force_, velocity_;  // scratch
};

/// What conjugate gradients have found.
struct Solution {
  Eigen::VectorXd numbers;
  int iterations = 0;  ///< before the last one
  double error = 0;    ///< of the right side, over its norm
};

/// Conjugate gradients from zero, until the error is at most `tolerance`. Those of Eigen would do, if their
/// sums could be made by several ranks, in one order.
Solution conjugate_gradients(const Equations& equations, const Eigen::VectorXd& right_side, double tolerance,
                             int most_iterations) {
  Solution found{Eigen::VectorXd::Zero(right_side.size())};
  Eigen::VectorXd residual = right_side, direction = right_side;
  const double right_square = equations.dot(right_side, right_side);
  const double enough = std::max(tolerance * tolerance * right_square, std::numeric_limits<double>::min());
  double square = right_square;
  for (; square >= enough && found.iterations < most_iterations; ++found.iterations) {
    const Eigen::VectorXd product = equations.product(direction);
    const double step = square / equations.dot(direction, product);
    found.numbers += step * direction;
    residual -= step * product;
    const double before = square;
    square = equations.dot(residual, residual);
    if (square < enough) break;
    direction = residual + (square / before) * direction;
  }
  if (right_square > 0) found.error = std::sqrt(square / right_square);
  return found;
}

[[noreturn]] void refuse(int iterations, double error, const ImplicitSettings& settings) {
  if (!std::isfinite(error))
    throw NotConverged("the velocities of membrane nodes without the implicit viscous forces are not finite");
  throw NotConverged(
      fmt::format("the implicit viscous forces were not found: after {} iterations their rates are off by "
                  "{:.3g} of their "
                  "norm, above coupler.implicit_tolerance = {:g}; raise coupler.implicit_iterations (in the "
                  "echo.toml of a run that "
                  "is resumed, too)",
                  iterations, error, settings.tolerance));
}

/// From a guess; most steps need no iteration, and then one look at the fluid. The unknown is what is missing
/// from the guess. How large the rates are is known from their solution only, so that it may take more than
/// one go.
/// @return iterations
int solve(const Equations& equations, const NodeVectors& force, const ImplicitSettings& settings,
          Eigen::VectorXd& stress) {
  const Eigen::VectorXd memory = equations.memory();
  for (int iterations = 0;;) {
    const Eigen::VectorXd rates = equations.rates_under(stress, force);
    const Eigen::VectorXd missing = rates + memory - equations.diagonal(stress);
    const double error = equations.norm(missing), scale = equations.norm(rates);
    if (error <= settings.tolerance * scale) return iterations;
    if (!std::isfinite(error) || iterations >= settings.most_iterations)
      refuse(iterations, error / scale, settings);
    const auto change = conjugate_gradients(equations, missing, 0.5 * settings.tolerance * scale / error,
                                            settings.most_iterations - iterations);
    stress += change.numbers;
    iterations += std::max(1, change.iterations);
    const double left = change.error * error;
    if (left <= settings.tolerance * equations.norm(equations.diagonal(stress) - memory)) return iterations;
  }
}

}  // namespace

ImplicitSettings implicit_settings(const Case& the_case) {
  return {the_case.coupler.implicit_tolerance, the_case.coupler.implicit_iterations,
          the_case.run.threads > 0 ? the_case.run.threads : omp_get_max_threads()};
}

int add_implicit_forces(std::vector<CapsuleMembrane>& membranes, const coupler::Coupler& coupler,
                        const NodeCorrections& corrections, const GridVectors& free,
                        const ImplicitSettings& settings, NodeVectors& force) {
  const auto nodes = coupler.grid_node_list();
  const bool fits = are_on(free, nodes);
  const GridVectors picked = fits ? GridVectors() : on_nodes(free, nodes, "free velocity");
  const GridVectors& touched = fits ? free : picked;
  WholeMobility mobility(membranes, coupler, corrections, touched, settings.threads);
  return add_implicit_forces(membranes, mobility, settings, force);
}

int add_implicit_forces(std::vector<CapsuleMembrane>& membranes, NodeMobility& mobility,
                        const ImplicitSettings& settings, NodeVectors& force) {
  Equations equations(membranes, mobility);
  Eigen::VectorXd stress = equations.guess();
  const int iterations = solve(equations, force, settings, stress);
  const auto& viscous = equations.forces_of(stress);
  for (std::size_t k = 0; k < force.size(); ++k) force[k] -= viscous[k];
  equations.accept(stress);
  return iterations;
}

void move_freely(const GridVectors& free, bool with_free, int threads, std::span<double> on_grid) {
  const auto n_numbers = static_cast<std::ptrdiff_t>(on_grid.size());
#pragma omp parallel for num_threads(threads) schedule(static)
  for (std::ptrdiff_t k = 0; k < n_numbers; ++k)
    on_grid[k] = (with_free ? free.values[k] : 0) + free.mobility[k / 3] * on_grid[k];
}

}  // namespace tanktread::driver
