#include "driver/plan/step_error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "driver/case/case_programs.hpp"

namespace tanktread::driver {
namespace {

// Beyond these nothing was measured.
constexpr double most_reynolds = 0.6, most_compression = 4.6e-3;
constexpr double least_tau = 1.0, most_tau = 3.0;
constexpr double least_capillary = 0.2, most_capillary = 1.2;
constexpr double least_radius = 6.3, most_radius = 9.6;  // grid steps
constexpr double least_box = 6.2, most_box = 9.1;        // radii, the shortest side

ShapeError sum(const ShapeError& a, const ShapeError& b) {
  return {a.deformation + b.deformation, a.inclination_deg + b.inclination_deg};
}

double largest_of_D(StepNumbers numbers, double times) {
  numbers.reynolds *= times;
  numbers.compression *= times;
  return step_error(numbers).largest().deformation;
}

std::string outside(const std::string& name, double value, double least, double most) {
  if (value >= least && value <= most) return "";
  return fmt::format("{} = {:.4g}: measured was {:g} to {:g}", name, value, least, most);
}

}  // namespace

ShapeError StepError::early() const {
  return sum(unsteady, late());
}

ShapeError StepError::late() const {
  return sum(compression, inertia);
}

ShapeError StepError::largest() const {
  const auto a = early(), b = late();
  return {std::max(std::abs(a.deformation), std::abs(b.deformation)),
          std::max(std::abs(a.inclination_deg), std::abs(b.inclination_deg))};
}

StepError step_error(const StepNumbers& numbers) {
  // All but what goes with Ca_G and the start are a fit to the map, which has Ca_G = 0.6 and the developed
  // flow; the rest to the group `elsewhere`.
  const auto& [re, k, ca, inertia, from_rest] = numbers;
  StepError error;
  error.unsteady = from_rest
                       ? ShapeError{-0.001 * re, 0.34 * re}
                       : ShapeError{-0.0085 * std::pow(ca / 0.6, 0.4) * re, -(0.22 + 0.5 * (ca - 0.6)) * re};
  error.compression = {1.275 / (0.13 + ca) * k, -(41 - 25 * ca) * k};
  if (inertia) error.inertia = {0.0505 * re + 0.0102 * re * re - 0.49 * k, 3.54 * re - 0.28 * re * re};
  return error;
}

std::string not_measured(const Case& the_case, const Parameters& parameters) {
  if (has_program(the_case)) return "a program in the place of a component: none was measured";
  const auto& flow = the_case.flow;
  if (flow.kind != "shear") return fmt::format("flow.kind = \"{}\": measured was shear", flow.kind);
  if (the_case.capsules.size() != 1) return "several capsules: measured was one";
  if (flow.body_force != std::array<double, 3>{}) return "flow.body_force: measured was none";
  if (flow.collision == "bgk" && flow.relaxation_time != 1)
    return fmt::format("flow.collision = \"bgk\" with tau+ = {:g}: measured was 1", flow.relaxation_time);
  if (flow.collision == "trt" && flow.magic_parameter != FlowCase().magic_parameter)
    return fmt::format("flow.magic_parameter = {:g}: measured was {:g}", flow.magic_parameter,
                       FlowCase().magic_parameter);
  if (the_case.coupler != CouplerCase()) return "[coupler]: measured was the default";
  const auto& capsule = parameters.capsules.front();
  if (capsule.viscous) return "membrane.viscous: measured were elastic membranes";
  if (capsule.energy.any()) return "energies of the whole membrane (bending_modulus, ...): measured was none";
  if (capsule.shear_modulus == 0) return "membrane.elastic_law: measured were laws with a shear modulus";
  const auto numbers = step_numbers(the_case, parameters);
  const double radius = the_case.capsules.front().radius;
  for (const auto& problem : {outside("radius", radius, least_radius, most_radius),
                              outside("shortest side of the box over the radius",
                                      *std::ranges::min_element(flow.box) / radius, least_box, most_box),
                              outside("tau+", parameters.relaxation_time, least_tau, most_tau),
                              outside("Ca_G", numbers.capillary, least_capillary, most_capillary),
                              outside("Re", numbers.reynolds, 0, most_reynolds),
                              outside("3 nu g", numbers.compression, 0, most_compression)}) {
    if (!problem.empty()) return problem;
  }
  return "";
}

StepNumbers step_numbers(const Case& the_case, const Parameters& parameters) {
  return {parameters.reynolds_number, 3 * parameters.kinematic_viscosity * parameters.shear_rate,
          parameters.capsules.front().capillary_by_G_s, the_case.flow.inertia, the_case.flow.start == "rest"};
}

double longest_step(const StepNumbers& numbers, double accuracy) {
  // The error grows with the step: from none to that of the largest one.
  double least = 0, most = longest_measured_step(numbers);
  if (largest_of_D(numbers, most) <= accuracy) return most;
  constexpr int n_halvings = 60;
  for (int k = 0; k < n_halvings; ++k) {
    const double middle = 0.5 * (least + most);
    (largest_of_D(numbers, middle) <= accuracy ? least : most) = middle;
  }
  return least;
}

double longest_measured_step(const StepNumbers& numbers) {
  return std::min(most_reynolds / numbers.reynolds, most_compression / numbers.compression);
}

}  // namespace tanktread::driver
