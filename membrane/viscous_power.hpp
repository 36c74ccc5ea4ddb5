// What becomes of the power that goes into the viscous stress of a membrane.
#pragma once

namespace tanktread::membrane {

/// Sums over a membrane at one time, force times length per time. With the rates of the dashpots D_d of the
/// present stress tau_v = mu_s (2 D_d - tr(D_d) I) + mu_d tr(D_d) I (Eq. 2.9), D' the part of D without
/// trace, and the rates D of the nodes' velocities:
struct ViscousPower {
  double shear = 0;         ///< sum A mu_s 2 D_d':D_d', dissipated
  double dilatational = 0;  ///< sum A mu_d (tr D_d)^2, dissipated
  /// sum A tau_v:(D - D_d), taken up by the springs in series with the dashpots (negative: given back); 0
  /// where there is no spring.
  double spring = 0;
};

}  // namespace tanktread::membrane
