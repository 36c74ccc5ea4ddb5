// Where the power goes that drives a system: the budget of its energy at one time.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "driver/observe/exact_sum.hpp"
#include "driver/system/capsules_now.hpp"

namespace tanktread::driver {

/// Of an energy of whole membranes beside their laws (docs/energy-terms.md), of all membranes.
struct TermBudget {
  std::string name;   ///< of the table of terms
  double energy = 0;  ///< Membrane::term_energies
  double power = 0;   ///< - sum F.u_m: what it stores
};

/// One row of energy.csv, of the whole system. Sums over nodes are exact sums, those over membranes are in
/// the order of the case, so that no number depends on threads and ranks. In lattice units (energy: density
/// times grid step^5 per time step^2). x_m, F_m and u_m are place, force and velocity of the membrane nodes
/// at the time of the row, u the velocity of the fluid.
struct EnergyBudget {
  std::int64_t step = 0;
  double shear_time = 0;
  double elastic_energy = 0;        ///< of the laws of all membranes (Membrane::elastic_energy)
  double elastic_power = 0;         ///< - sum F_elastic.u_m: what the elastic stress stores
  double viscous_shear = 0;         ///< dissipated in the membranes (ViscousPower)
  double viscous_dilatational = 0;  ///< likewise
  double spring_power = 0;          ///< taken up by the springs of Maxwell elements (ViscousPower)
  /// sum 2 mu S:S over the nodes inside capsules (Fluid::dissipation). Not a number where capsules of the
  /// viscosity outside overlap, so that inside and outside cannot be told: `outer` is that of all nodes then.
  double inner = 0;
  double outer = 0;           ///< over all others
  double walls = 0;           ///< power of the moving walls (Fluid::wall_power)
  double body_force = 0;      ///< sum F_b.u
  double correction = 0;      ///< sum F_m.(what was added to the interpolated velocity, for u_m)
  double kinetic_energy = 0;  ///< sum rho u^2/2; without inertia rho = 1
  /// walls + body_force + load_power - elastic_power - viscous_shear - viscous_dilatational - spring_power -
  /// inner - outer - correction - the powers of the terms - the rate of kinetic_energy over the step to come,
  /// under the present force.
  double remainder = 0;
  double load_power = 0;          ///< sum F_load.u_m: what the loads put in
  std::vector<TermBudget> terms;  ///< those of the case, in the order of their table
};

/// What one membrane adds to it: of the same names as there.
struct MembraneBudget {
  double elastic_energy = 0, elastic_power = 0, viscous_shear = 0, viscous_dilatational = 0, spring_power = 0,
         correction = 0, load_power = 0;
  std::vector<TermBudget> terms;
};

/// @param velocity u_m of the time of the budget, of each; `interpolated` what of it the coupler interpolates
/// @param terms of the case (term_names())
std::vector<MembraneBudget> membrane_budgets(const CapsulesNow& capsules,
                                             std::span<const Eigen::Matrix3Xd> interpolated,
                                             std::span<const Eigen::Matrix3Xd> velocity,
                                             const std::vector<std::string>& terms);

/// What a flow, or a part of one, adds to it: of the same names as there.
struct FlowBudget {
  bool knows_inside = true;  ///< else `inner` is empty
  ExactSum inner, outer, walls, body_force, kinetic_energy;
  ExactSum next_kinetic_energy;  ///< one step on, under the present force

  /// The budget of another part of the same flow.
  void add(const FlowBudget& other);
};

/// @param fluid of the case, or a part of it
/// @param marks of its nodes (coupler::InsideMarks); none: inside and outside cannot be told
/// @param threads which do not change it
FlowBudget flow_budget(const fluid::Fluid& fluid, std::optional<std::span<const std::int32_t>> marks,
                       const Case& the_case, int threads);

/// The budget of a whole system of its membranes, in the order of the case, and of its flow.
EnergyBudget energy_budget(std::int64_t step, double shear_time, const std::vector<MembraneBudget>& membranes,
                           const FlowBudget& flow);

/// The system stands at a time t between two steps. inner and outer are of the populations that come in at
/// t + 1, walls of the exchange on the way there, the others of t.
/// @throws std::logic_error of a fluid that cannot tell
EnergyBudget energy_budget(const System& system, const Case& the_case);

/// First line of energy.csv. @param terms of the case (term_names()): two columns more for each
std::string energy_header(const std::vector<std::string>& terms);
/// A row, 17 significant digits.
std::string energy_row(const EnergyBudget& budget);

}  // namespace tanktread::driver
