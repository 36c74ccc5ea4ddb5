// Membrane viscosity of an element: the increment of its strain in, its viscous stress out.
#pragma once

#include <array>

#include "membrane/element.hpp"
#include "membrane/maxwell.hpp"
#include "membrane/symmetric_tensor.hpp"
#include "membrane/viscous_parameters.hpp"

namespace tanktread::membrane {

/// A viscous stress in the frame that turns with the element (the polar rotation R of F = R U): the shear
/// parts (s11 - s22)/2 and s12, and the dilatational part (s11 + s22)/2 (Eqs. 2.20-2.24). The state of an
/// element. Components kept in this frame make the rate of the Maxwell element the Green-Naghdi (polar) one,
/// with the spin (dR/dt) R^T; not the Jaumann rate, whose spin is the vorticity.
using ViscousState = std::array<double, 3>;

/// tau_v = mu_s (2 D - tr(D) I) + mu_d tr(D) I (Eq. 2.9), each of its three independent parts a Maxwell
/// element with (Table 3.1) viscosity 2 mu_s and spring k_s' (shear), or 2 mu_d and k_d' (dilatation). Const,
/// keeps nothing.
///
/// The strain increment of a step is U^-1 [E(t + dt) - E(t)] U^-1, which is the increment of D dt in the
/// frame of R. U is taken between the two times, from the mean of their Cg, because the Maxwell update is
/// centred there: with U at either end the scheme would be of first order in dt. The stress so found holds at
/// t + dt, where the nodal force is taken.
class ViscousLaw {
 public:
  /// @throws std::invalid_argument naming the parameter that is out of range
  explicit ViscousLaw(const ViscousParameters& parameters);

  int interval() const { return interval_; }
  StrainSampling sampling() const { return sampling_; }

  /// Carries the stress of an element from strain E at the last update to E now (Green strains, Eq. 2.8).
  /// Here, to be inlined into the loop over elements.
  void advance(const SymmetricTensor& last_strain, const SymmetricTensor& strain, ViscousState& state) const {
    SymmetricTensor increment = strain - last_strain;
    if (measure_ == StressMeasure::rate_of_deformation) {
      const SymmetricTensor mean_cauchy_green = unit_tensor + last_strain + strain;
      increment = on_both_sides(right_stretch(mean_cauchy_green).inverse, increment);
    }
    state[0] = shear_.advance(state[0], 0.5 * (increment.xx - increment.yy));
    state[1] = shear_.advance(state[1], increment.xy);
    state[2] = dilatation_.advance(state[2], 0.5 * increment.trace());
  }

  /// What the dashpots dissipate under a stress (in the frame of R), in shear and in dilatation, per area:
  /// with the rates D_d that make this stress, mu_s 2 D_d':D_d' = (s0^2 + s1^2)/mu_s of the shear parts of
  /// ViscousState, and mu_d (tr D_d)^2 = s2^2/mu_d. 0 where the viscosity is.
  Eigen::Vector2d dissipation(const SymmetricTensor& stress) const {
    const double difference = 0.5 * (stress.xx - stress.yy), mean = 0.5 * stress.trace();
    return {shear_viscosity_ > 0 ? (difference * difference + stress.xy * stress.xy) / shear_viscosity_ : 0.0,
            dilatational_viscosity_ > 0 ? mean * mean / dilatational_viscosity_ : 0.0};
  }

  /// The Cauchy stress in the frame of R, force per length.
  static SymmetricTensor stress(const ViscousState& state) {
    return {state[2] + state[0], state[1], state[2] - state[0]};
  }

 private:
  int interval_;
  double shear_viscosity_, dilatational_viscosity_;
  StrainSampling sampling_;
  StressMeasure measure_;
  MaxwellStep shear_, dilatation_;  ///< all zero where the viscosity is
};

}  // namespace tanktread::membrane
