#include "unit/membrane_law_list.hpp"

#include <algorithm>
#include <cmath>

namespace tanktread::membrane::test {
namespace {

// dW/dlambda1 of Eq. 2.4 is E_s/2 lambda1 [lambda1^2 - 1 + C lambda2^2 I2], with E_s = 2 G_s.
double skalak(const ElasticParameters& p, double a, double b) {
  return p.shear_modulus * a / b * (a * a - 1 + p.area_ratio * b * b * (a * a * b * b - 1));
}

// W = G_s/2 [lambda1^2 + lambda2^2 + (lambda1 lambda2)^-2 - 3].
double neo_hookean(const ElasticParameters& p, double a, double b) {
  return p.shear_modulus / (a * b) * (a * a - 1 / (a * a * b * b));
}

// With E_i = (lambda_i^2 - 1)/2, dW/dlambda1 = 2 G_s/(1 - nu_s) lambda1 (E_1 + nu_s E_2).
double hookean(const ElasticParameters& p, double a, double b) {
  const double nu = p.poisson_ratio;
  return p.shear_modulus / (1 - nu) * a / b * (a * a - 1 + nu * (b * b - 1));
}

// W = gamma lambda1 lambda2.
double interfacial_tension(const ElasticParameters& p, double, double) {
  return p.interfacial_tension;
}

double none(const ElasticParameters&, double, double) {
  return 0;
}

}  // namespace

const std::vector<LawRow>& law_list() {
  // name, parameters, closed form, G_s, K_s, tension at rest, tau at (2, 1), tau at (2, 2)
  static const std::vector<LawRow> list = {
      {"skalak", {.shear_modulus = 3, .area_ratio = 2}, skalak, 3, 15, 0, {54, 36}, 369},
      {"neo-hookean", {.shear_modulus = 3}, neo_hookean, 3, 9, 0, {5.625, 1.125}, 2.953125},
      {"hookean", {.shear_modulus = 3, .poisson_ratio = 0.25}, hookean, 3, 5, 0, {24, 1.5}, 15},
      {"interfacial-tension", {.interfacial_tension = 3}, interfacial_tension, 0, 0, 3, {3, 3}, 3},
      {"none", {}, none, 0, 0, 0, {0, 0}, 0},
  };
  return list;
}

std::vector<LawRow> laws_with_a_force() {
  std::vector<LawRow> laws;
  for (const auto& row : law_list())
    if (row.shear_modulus + row.area_modulus + row.tension_at_rest > 0) laws.push_back(row);
  return laws;
}

double stress_sensitivity(const LawRow& row, double lambda1, double lambda2) {
  const auto stress = [&](double a, double b) { return row.principal_stress(row.parameters, a, b); };
  const double step = 1e-4, here = stress(lambda1, lambda2);
  return std::abs(here) + std::abs(stress(lambda1 + step, lambda2) - here) / step +
         std::abs(stress(lambda1, lambda2 + step) - here) / step;
}

std::ostream& operator<<(std::ostream& out, const LawRow& row) {
  return out << row.name;
}

std::string test_name(const LawRow& row) {
  std::string name = row.name;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

}  // namespace tanktread::membrane::test
