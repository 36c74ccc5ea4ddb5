// The one place where dimensionless and SI numbers become lattice units and back.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "driver/case.hpp"
#include "membrane/elastic_law.hpp"

namespace tanktread::driver {

/// What follows for one capsule, lattice units unless said otherwise.
struct CapsuleParameters {
  double radius = 0;
  double shear_modulus = 0;        ///< G_s; 0 for an interfacial tension
  double skalak_modulus = 0;       ///< E_s = 2 G_s (the thesis's form W = E_s/8 ...)
  double area_modulus = 0;         ///< K_s at rest, from the law
  double interfacial_tension = 0;  ///< gamma
  double capillary_by_E_s = 0, capillary_by_G_s = 0,
         capillary_by_gamma = 0;  ///< mu_o g a / modulus; 0 if it has none
  double viscosity_ratio = 1;
};

/// The elastic law of a capsule with its moduli in lattice units.
std::unique_ptr<membrane::ElasticLaw> elastic_law(const MembraneCase& membrane,
                                                  const CapsuleParameters& capsule);

/// What follows for the flow, lattice units unless said otherwise.
struct Parameters {
  double kinematic_viscosity = 0;                ///< nu = (tau+ - 1/2)/3
  double relaxation_time = 0;                    ///< tau+
  double relaxation_time_odd = 0;                ///< tau-
  double shear_rate = 0;                         ///< g = 2 U0/L (or given: periodic)
  double wall_speed = 0;                         ///< U0; poiseuille: undisturbed centre speed; periodic: 0
  double reynolds_number = 0;                    ///< g a^2/nu, a of the first capsule
  double mach_number = 0;                        ///< U0 sqrt(3); periodic: g a sqrt(3)
  std::array<double, 3> body_force = {0, 0, 0};  ///< of the kind (poiseuille) and the key together
  double steps_per_shear_time = 0;               ///< 1/g
  std::vector<CapsuleParameters> capsules;
};

/// Works out all of the above. Lattice units: density 1, so that mu_o = nu. Formulas: docs/units.md.
Parameters parameters(const Case& the_case);

/// SI values of lattice units, there when the case has [si]: metres a grid step, seconds a step, newtons a
/// lattice force.
struct SiScales {
  double length_m, time_s, force_N;
  double reynolds_number_physical;  ///< of the [si] values; the case may override it
};
std::optional<SiScales> si_scales(const Case& the_case, const Parameters& parameters);

/// Warnings a user should read before a run, each a sentence with the number, the bound and the key to
/// change: Mach > 0.1, tau+ outside 0.55 to 2, Re > 1 with inertia, a wall faster than the speed limit; mesh
/// edge outside 0.5 to 2 grid steps; less than a radius to a wall or the periodic image, less than two kernel
/// half-widths between capsules; membrane viscosity given but switched off; output intervals that rounding to
/// whole steps changes by more than 1 %.
/// @param mean_edges mean mesh edge of each capsule, grid steps; empty: not known
std::vector<std::string> warnings(const Case& the_case, const Parameters& parameters,
                                  const std::vector<double>& mean_edges);

/// What a run costs, from the parameters and a measured speed.
struct Cost {
  double mlups = 0;  ///< million node updates a second; 0: not measured
  double run_seconds = 0;
  double memory_bytes = 0;
  double disk_bytes = 0;
};

/// The echo: aligned text in sections, at most 100 columns wide (the title apart): one line a number, with
/// its SI value if the case has [si], and formula; it ends with the cost and the warnings.
/// @param mean_edges mean mesh edge of each capsule, grid steps; empty: not known yet, and left out
std::string echo(const Case& the_case, const Parameters& parameters, const Cost& cost,
                 const std::vector<std::string>& warnings, const std::vector<double>& mean_edges = {});

}  // namespace tanktread::driver
