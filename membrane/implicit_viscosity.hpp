// Membrane viscosity whose force depends on the velocity of its own time: no strain to store, no spring
// needed.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

#include "membrane/strain_rates.hpp"
#include "membrane/viscous_parameters.hpp"
#include "membrane/viscous_power.hpp"

namespace tanktread::membrane {

/// The viscous stresses of a membrane at time t+1, s = B u(t+1) (StrainRates), from a velocity that is not
/// known yet, because it follows from these stresses too. With M the mobility of the nodes, what a nodal
/// force adds to the velocities of its own time, and u0 those without the viscous force -B^T s,
///
///     s = B (u0 - M B^T s)      so      (1 + theta + B M B^T) s = B u0 + theta s(t),
///
/// where theta is zero, or with a spring the relaxation time of the Maxwell element in steps: its law s +
/// theta ds/dt = B u, with ds/dt = s(t+1) - s(t) in axes that turn with the material (of first order in
/// 1/theta). The matrix is symmetric and positive, for M is; so the equations of all membranes are solved
/// together by conjugate gradients. This class has the parts of them that are the membrane's: who knows M
/// puts them together.
///
/// An array of s has three numbers a column (StrainRates::n_rates() columns).
class ImplicitViscosity {
 public:
  /// @param triangles as of StrainRates
  /// @param threads OpenMP threads, 0: all; no result depends on it, to the last bit
  /// @throws std::invalid_argument naming the parameter that is out of range; as StrainRates()
  ImplicitViscosity(Eigen::Matrix3Xi triangles, Eigen::Index n_nodes, const ImplicitParameters& parameters,
                    int threads = 0);

  /// B of the positions given. The symbols above are of its rates.
  const StrainRates& rates() const { return rates_; }

  /// The positions x(t+1), once a step and before it. With a spring the stresses that are remembered turn
  /// with the material from the positions before. @throws as StrainRates::set_positions()
  void set_positions(const Eigen::Ref<const Eigen::Matrix3Xd>& positions);

  /// 2 s(t) - s(t-1), for the equations to be solved from.
  Eigen::Matrix3Xd guess() const { return 2 * stress_ - stress_before_; }

  /// theta s(t). @param numbers 3 x n_rates(), added to
  void add_memory(Eigen::Ref<Eigen::Matrix3Xd> numbers) const;
  /// (1 + theta) s. @param stress, numbers 3 x n_rates(); numbers are added to
  void add_diagonal(const Eigen::Ref<const Eigen::Matrix3Xd>& stress,
                    Eigen::Ref<Eigen::Matrix3Xd> numbers) const;

  /// s(t+1) is found; the time is t+1 from now on.
  /// @throws std::invalid_argument if the number of columns is not n_rates()
  void accept(const Eigen::Ref<const Eigen::Matrix3Xd>& stress);

  /// s(t+1) of a velocity that is given, in place of equations: (B u + theta s(t))/(1 + theta).
  /// @param velocity 3 x n_nodes, of the nodes at the positions set
  Eigen::Matrix3Xd stress_of(const Eigen::Ref<const Eigen::Matrix3Xd>& velocity) const;

  /// s(t).
  const Eigen::Matrix3Xd& stress() const { return stress_; }

  /// What becomes of the power that velocities of the nodes put into the stress s(t): |s|^2 is dissipated, a
  /// part with a spring takes s.(B u - s) besides. Without springs B u differs from s by what the equations
  /// were not solved to, which is in none of the three.
  /// @param velocity u, 3 x n_nodes, of the nodes at the positions set
  ViscousPower power(const Eigen::Ref<const Eigen::Matrix3Xd>& velocity) const;

  /// Numbers that append_to() appends: s(t), then s(t-1).
  std::size_t n_values() const { return static_cast<std::size_t>(2 * stress_.size()); }
  /// Everything beyond positions that a restart needs.
  void append_to(std::vector<double>& values) const;
  /// @param values n_values() numbers as append_to() gave them @throws std::invalid_argument for another
  /// number
  void restore(std::span<const double> values);

 private:
  StrainRates rates_;
  Eigen::Array3d theta_;  ///< of the three numbers of a column
  bool has_positions_ = false;
  Eigen::Matrix3Xd stress_, stress_before_;
};

}  // namespace tanktread::membrane
