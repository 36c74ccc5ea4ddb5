// What the length of a step does to the shape of an elastic capsule in shear flow: a fit to what was measured
// (docs/accuracy.md, "How large a step").
#pragma once

#include <string>

#include "driver/case/case.hpp"
#include "driver/units/units.hpp"

namespace tanktread::driver {

/// The numbers that it goes by.
struct StepNumbers {
  double reynolds = 0;     ///< Re = g a^2/nu
  double compression = 0;  ///< K = 3 nu g: mu g over rho c_s^2, which goes with the pressure in the capsule
  double capillary = 0;    ///< Ca_G = mu g a/G_s
  bool inertia = true;     ///< flow.inertia
  bool from_rest = true;   ///< flow.start
};

/// Of a step against an infinitely short one in Stokes flow.
struct ShapeError {
  double deformation = 0;      ///< share of D
  double inclination_deg = 0;  ///< degrees
};

/// In parts.
struct StepError {
  ShapeError unsteady;  ///< a fluid takes its time, also without inertia; gone where the shape stands still
  ShapeError compression;  ///< the lattice is compressible: the volume falls
  ShapeError inertia;      ///< of the quadratic terms; 0 without

  /// While the shape changes: all three.
  ShapeError early() const;
  /// Where it stands still: without the first.
  ShapeError late() const;
  /// The larger of the two, of D and of the inclination for itself; without sign.
  ShapeError largest() const;
};

StepError step_error(const StepNumbers& numbers);

/// Why nothing is known of the step of a case: "" if it lies within what was measured, else what does not,
/// for a message: "flow.kind = \"poiseuille\": measured was shear".
std::string not_measured(const Case& the_case, const Parameters& parameters);

/// Of a case within what was measured.
StepNumbers step_numbers(const Case& the_case, const Parameters& parameters);

/// How many times as long a step may be at the same tau+ (as many times the wall speed, as few steps), so
/// that the largest error of D is no more than `accuracy`, and the step still within what was measured.
double longest_step(const StepNumbers& numbers, double accuracy);

/// The same of the longest that was measured, whatever its error.
double longest_measured_step(const StepNumbers& numbers);

}  // namespace tanktread::driver
