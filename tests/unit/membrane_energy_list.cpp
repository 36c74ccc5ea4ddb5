#include "unit/membrane_energy_list.hpp"

#include <set>

namespace tanktread::membrane::test {

const std::vector<EnergyRow>& energy_list() {
  static const std::vector<EnergyRow> list = {
      {"bending", {"bending", {{"bending_modulus", 1.5}}}, false},
      {"bending_with_spontaneous_curvature",
       {"bending", {{"bending_modulus", 1.5}, {"spontaneous_curvature", 0.6}}},
       false},
      {"global_area", {"global-area", {{"area_modulus", 3}}}, true},
      {"global_area_of_another", {"global-area", {{"area_modulus", 3}, {"reference_area", 40}}}, false},
      {"local_area", {"local-area", {{"local_area_modulus", 2}}}, true},
      {"local_area_of_another", {"local-area", {{"local_area_modulus", 2}, {"reference_area", 40}}}, false},
      {"volume", {"volume", {{"volume_modulus", 5}}}, true},
      {"volume_of_another", {"volume", {{"volume_modulus", 5}, {"reference_volume", 20}}}, false},
  };
  return list;
}

std::vector<EnergyChoice> one_of_each() {
  std::set<std::string> taken;
  std::vector<EnergyChoice> choices;
  for (const auto& row : energy_list())
    if (taken.insert(row.choice.name).second) choices.push_back(row.choice);
  return choices;
}

Eigen::Matrix3Xd forces(EnergyTerms& terms, const Eigen::Matrix3Xd& positions) {
  Eigen::Matrix3Xd force = Eigen::Matrix3Xd::Zero(3, positions.cols());
  terms.add_forces(positions, force);
  return force;
}

std::ostream& operator<<(std::ostream& out, const EnergyRow& row) {
  return out << row.title;
}

}  // namespace tanktread::membrane::test
