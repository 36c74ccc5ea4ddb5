#include "driver/system/implicit_forces.hpp"

#include <fmt/format.h>
#include <omp.h>

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>
#include <utility>

#include "driver/system/node_ranges.hpp"
#include "driver/system/node_spans.hpp"

namespace tanktread::driver {
namespace {

class Equations;

}  // namespace
}  // namespace tanktread::driver

// What Eigen asks of a matrix that is known by its products only.
template <>
struct Eigen::internal::traits<tanktread::driver::Equations>
    : Eigen::internal::traits<Eigen::SparseMatrix<double>> {};

namespace tanktread::driver {
namespace {

/// M: what nodal forces add to the velocity of the nodes at their own time.
class NodeMobility {
 public:
  /// All is borrowed. @param of_grid_nodes that of each grid node that the stencils touch
  NodeMobility(const std::vector<CapsuleMembrane>& membranes, const coupler::Coupler& coupler,
               const NodeCorrections& corrections, const std::vector<double>& of_grid_nodes, int threads)
      : coupler_(coupler),
        corrections_(corrections),
        of_grid_nodes_(of_grid_nodes),
        n_threads_(threads),
        on_grid_(3 * of_grid_nodes.size()) {
    if (!corrections.along_membrane) return;
    std::vector<std::span<const double>> positions;
    std::vector<std::span<const int>> triangles;
    for (const auto& membrane : membranes) {
      positions.push_back(numbers_of(membrane.positions()));
      triangles.push_back(numbers_of(membrane.reference().triangles));
    }
    normals_ = corrections.normals->find(positions, triangles);
  }

  /// @param free velocity that the grid nodes have without forces, 3 a node; empty: none
  /// @param velocity overwritten
  void velocity_of(const NodeVectors& force, std::span<const double> free, NodeVectors& velocity) {
    const auto forces = views(force);
    const auto targets = targets_of(velocity);
    coupler_.spread(forces, on_grid_);
    const auto n_numbers = static_cast<std::ptrdiff_t>(on_grid_.size());
#pragma omp parallel for num_threads(n_threads_) schedule(static)
    for (std::ptrdiff_t k = 0; k < n_numbers; ++k)
      on_grid_[k] = (free.empty() ? 0 : free[k]) + of_grid_nodes_[k / 3] * on_grid_[k];
    coupler_.interpolate(on_grid_, targets);
    if (corrections_.along_membrane) corrections_.along_membrane->add(coupler_, normals_, forces, targets);
  }

 private:
  const coupler::Coupler& coupler_;
  const NodeCorrections& corrections_;
  const std::vector<double>& of_grid_nodes_;
  int n_threads_;
  std::span<const std::span<const double>> normals_;
  std::vector<double> on_grid_;
};

/// The numbers of the stresses of all membranes, one membrane after the other, and the matrix of their
/// equations.
class Equations : public Eigen::EigenBase<Equations> {
 public:
  // The words of Eigen for a matrix.
  using Scalar = double;
  using RealScalar = double;
  using StorageIndex = int;
  enum { ColsAtCompileTime = Eigen::Dynamic, MaxColsAtCompileTime = Eigen::Dynamic, IsRowMajor = false };
  Eigen::Index rows() const { return n_numbers_; }
  Eigen::Index cols() const { return n_numbers_; }
  template <class Vector>
  Eigen::Product<Equations, Vector, Eigen::AliasFreeProduct> operator*(
      const Eigen::MatrixBase<Vector>& vector) const {
    return {*this, vector.derived()};
  }

  Equations(std::vector<CapsuleMembrane>& membranes, NodeMobility mobility)
      : membranes_(membranes), mobility_(std::move(mobility)) {
    for (const auto& membrane : membranes) {
      const auto* viscosity = membrane.implicit_viscosity();
      first_.push_back(n_numbers_);
      if (viscosity != nullptr) n_numbers_ += 3 * viscosity->rates().n_rates();
      force_.emplace_back(Eigen::Matrix3Xd::Zero(3, membrane.n_nodes()));
    }
    velocity_ = zero_like(force_);
  }

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
  Eigen::VectorXd rates_under(const Eigen::VectorXd& stress, const NodeVectors& force,
                              std::span<const double> free) const {
    forces_of(stress);
    for (std::size_t k = 0; k < force.size(); ++k) force_[k] = force[k] - force_[k];
    mobility_.velocity_of(force_, free, velocity_);
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

  /// Adds (1 + theta + B M B^T) s times a factor.
  void add_product(Eigen::VectorXd& numbers, const Eigen::VectorXd& stress, double factor) const {
    if (stress.isZero(0)) return;  // Eigen asks for this one too
    mobility_.velocity_of(forces_of(stress), {}, velocity_);
    Eigen::VectorXd product(n_numbers_);
    for_each([&](std::size_t k, const auto& viscosity) {
      auto of_membrane = part(product, k, viscosity);
      viscosity.rates().multiply(velocity_[k], of_membrane);
      viscosity.add_diagonal(part(stress, k, viscosity), of_membrane);
    });
    numbers += factor * product;
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
  std::vector<Eigen::Index> first_;  ///< number of each membrane
  Eigen::Index n_numbers_ = 0;
  // Scratch; a matrix is const to Eigen.
  mutable NodeMobility mobility_;
  mutable NodeVectors force_, velocity_;
};

}  // namespace
}  // namespace tanktread::driver

template <typename Vector>
struct Eigen::internal::generic_product_impl<tanktread::driver::Equations, Vector, Eigen::SparseShape,
                                             Eigen::DenseShape, Eigen::GemvProduct>
    : Eigen::internal::generic_product_impl_base<
          tanktread::driver::Equations, Vector,
          Eigen::internal::generic_product_impl<tanktread::driver::Equations, Vector>> {
  using Scalar = double;

  template <typename Result>
  static void scaleAndAddTo(Result& result, const tanktread::driver::Equations& matrix, const Vector& vector,
                            const Scalar& factor) {
    matrix.add_product(result, vector, factor);
  }
};

namespace tanktread::driver {
namespace {

/// Its sums are made one after the other, so that the same bits follow whatever the threads.
using Solver =
    Eigen::ConjugateGradient<Equations, Eigen::Lower | Eigen::Upper, Eigen::IdentityPreconditioner>;

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
int solve(const Equations& equations, const NodeVectors& force, std::span<const double> free,
          const ImplicitSettings& settings, Eigen::VectorXd& stress) {
  const Eigen::VectorXd memory = equations.memory();
  for (int iterations = 0;;) {
    const Eigen::VectorXd rates = equations.rates_under(stress, force, free);
    const Eigen::VectorXd missing = rates + memory - equations.diagonal(stress);
    const double error = missing.norm(), scale = rates.norm();
    if (error <= settings.tolerance * scale) return iterations;
    if (!std::isfinite(error) || iterations >= settings.most_iterations)
      refuse(iterations, error / scale, settings);
    Solver solver(equations);
    solver.setTolerance(0.5 * settings.tolerance * scale / error);
    solver.setMaxIterations(settings.most_iterations - iterations);
    const Eigen::VectorXd change = solver.solve(missing);
    stress += change;
    iterations += std::max<int>(1, static_cast<int>(solver.iterations()));
    const double left = solver.error() * error;
    if (left <= settings.tolerance * (equations.diagonal(stress) - memory).norm()) return iterations;
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
  Equations equations(membranes, {membranes, coupler, corrections, touched.mobility, settings.threads});
  Eigen::VectorXd stress = equations.guess();
  const int iterations = solve(equations, force, touched.values, settings, stress);
  const auto& viscous = equations.forces_of(stress);
  for (std::size_t k = 0; k < force.size(); ++k) force[k] -= viscous[k];
  equations.accept(stress);
  return iterations;
}

}  // namespace tanktread::driver
