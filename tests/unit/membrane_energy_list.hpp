// The list of energy terms under test. A new term is one row in membrane_energy_list.cpp; every test of terms
// then runs on it, and a term of the table without a row fails.
#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "membrane/energy_terms.hpp"

namespace tanktread::membrane::test {

/// A term with parameters that suit a reference sphere of radius 2.
struct EnergyRow {
  std::string title;  ///< of the test
  EnergyChoice choice;
  bool rests;  ///< has neither energy nor force at the reference
};

const std::vector<EnergyRow>& energy_list();

/// One of each term of the table, for tests of all together.
std::vector<EnergyChoice> one_of_each();

/// Forces of the terms alone.
Eigen::Matrix3Xd forces(EnergyTerms& terms, const Eigen::Matrix3Xd& positions);

/// How GoogleTest names a row.
std::ostream& operator<<(std::ostream& out, const EnergyRow& row);

}  // namespace tanktread::membrane::test
