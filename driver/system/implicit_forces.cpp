#include "driver/system/implicit_forces.hpp"

#include <fmt/format.h>

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCore>
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
               const NodeCorrections& corrections, const std::vector<double>& of_grid_nodes)
      : coupler_(coupler),
        corrections_(corrections),
        of_grid_nodes_(of_grid_nodes),
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
    for (std::size_t k = 0; k < on_grid_.size(); ++k)
      on_grid_[k] = (free.empty() ? 0 : free[k]) + of_grid_nodes_[k / 3] * on_grid_[k];
    coupler_.interpolate(on_grid_, targets);
    if (corrections_.along_membrane) corrections_.along_membrane->add(coupler_, normals_, forces, targets);
  }

 private:
  const coupler::Coupler& coupler_;
  const NodeCorrections& corrections_;
  const std::vector<double>& of_grid_nodes_;
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

  /// From 2 s(t) - s(t-1).
  Eigen::VectorXd guess() const {
    Eigen::VectorXd numbers(n_numbers_);
    for_each([&](std::size_t k, const auto& viscosity) { part(numbers, k, viscosity) = viscosity.guess(); });
    return numbers;
  }

  /// B u0 + theta s(t). @param force F0
  Eigen::VectorXd right_side(const NodeVectors& force, std::span<const double> free) const {
    Eigen::VectorXd numbers(n_numbers_);
    mobility_.velocity_of(force, free, velocity_);
    for_each([&](std::size_t k, const auto& viscosity) {
      auto of_membrane = part(numbers, k, viscosity);
      viscosity.rates().multiply(velocity_[k], of_membrane);
      viscosity.add_memory(of_membrane);
    });
    return numbers;
  }

  /// Adds (1 + theta + B M B^T) s times a factor.
  void add_product(Eigen::VectorXd& numbers, const Eigen::VectorXd& stress, double factor) const {
    mobility_.velocity_of(forces_of(stress), {}, velocity_);
    Eigen::VectorXd product(n_numbers_);
    for_each([&](std::size_t k, const auto& viscosity) {
      auto of_membrane = part(product, k, viscosity);
      viscosity.rates().multiply(velocity_[k], of_membrane);
      viscosity.add_diagonal(part(stress, k, viscosity), of_membrane);
    });
    numbers += factor * product;
  }

  /// B^T s of every membrane, zero for those without an implicit viscosity.
  const NodeVectors& forces_of(const Eigen::VectorXd& stress) const {
    for_each([&](std::size_t k, const auto& viscosity) {
      viscosity.rates().multiply_transposed(part(stress, k, viscosity), force_[k]);
    });
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

ImplicitSettings implicit_settings(const Case& the_case) {
  return {the_case.coupler.implicit_tolerance, the_case.coupler.implicit_iterations};
}

int add_implicit_forces(std::vector<CapsuleMembrane>& membranes, const coupler::Coupler& coupler,
                        const NodeCorrections& corrections, const GridVectors& free,
                        const ImplicitSettings& settings, NodeVectors& force) {
  const auto nodes = coupler.grid_node_list();
  const bool fits = free.nodes == nodes || *free.nodes == *nodes;
  const GridVectors picked = fits ? GridVectors() : on_nodes(free, nodes, "free velocity");
  const GridVectors& touched = fits ? free : picked;
  for (auto& membrane : membranes) {
    auto* viscosity = membrane.implicit_viscosity();
    if (viscosity != nullptr) viscosity->set_positions(membrane.positions());
  }
  Equations equations(membranes, {membranes, coupler, corrections, touched.mobility});
  // One after the other, so that the same bits follow whatever the threads: the vectors are short.
  Eigen::ConjugateGradient<Equations, Eigen::Lower | Eigen::Upper, Eigen::IdentityPreconditioner> solver;
  solver.setTolerance(settings.tolerance);
  solver.setMaxIterations(settings.most_iterations);
  solver.compute(equations);
  const Eigen::VectorXd right_side = equations.right_side(force, touched.values);
  const Eigen::VectorXd stress = solver.solveWithGuess(right_side, equations.guess());
  if (solver.info() != Eigen::Success) {
    throw NotConverged(fmt::format(
        "the implicit viscous forces were not found: after {} iterations the residual is {:.3g} of the right "
        "side, above coupler.implicit_tolerance = {:g}; raise that or coupler.implicit_iterations",
        solver.iterations(), solver.error(), settings.tolerance));
  }
  const auto& viscous = equations.forces_of(stress);
  for (std::size_t k = 0; k < force.size(); ++k) force[k] -= viscous[k];
  equations.accept(stress);
  return static_cast<int>(solver.iterations());
}

}  // namespace tanktread::driver
