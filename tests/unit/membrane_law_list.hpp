// The list of elastic laws under test. A new law is one row in membrane_law_list.cpp; every test of laws then
// runs on it, and a law of the table without a row fails.
#pragma once

#include <array>
#include <ostream>
#include <string>
#include <vector>

#include "membrane/elastic_law.hpp"

namespace tanktread::membrane::test {

/// What is known about a law without its code. All numbers are for `parameters`.
struct LawRow {
  std::string name;
  ElasticParameters parameters;
  /// First principal Cauchy stress, (1/lambda2) dW/dlambda1 (Eq. 2.7), worked out by hand; the second follows
  /// by exchanging the stretches.
  double (*principal_stress)(const ElasticParameters&, double lambda1, double lambda2);
  double shear_modulus;                ///< G_s
  double area_modulus;                 ///< K_s
  double tension_at_rest;              ///< isotropic stress of the undeformed membrane
  std::array<double, 2> uniaxial_2_1;  ///< tau1, tau2 at lambda1 = 2, lambda2 = 1, a number by hand
  double equibiaxial_2_2;              ///< tau1 = tau2 at lambda1 = lambda2 = 2, a number by hand
};

const std::vector<LawRow>& law_list();

/// Those of the list that resist anything: all but none.
std::vector<LawRow> laws_with_a_force();

/// How much the principal stress changes with a stretch, plus the stress itself: the factor from a rounding
/// of strain to a rounding of stress. By differences of the closed form.
double stress_sensitivity(const LawRow& row, double lambda1, double lambda2);

/// How GoogleTest names a row.
std::ostream& operator<<(std::ostream& out, const LawRow& row);
std::string test_name(const LawRow& row);

}  // namespace tanktread::membrane::test
