#include "unit/membrane_viscous_support.hpp"

#include <cmath>

#include "membrane/element.hpp"
#include "membrane/viscous_law.hpp"

namespace tanktread::membrane::test {

std::vector<ViscousForm> viscous_forms() {
  std::vector<ViscousForm> forms;
  for (const auto& scheme : maxwell_schemes()) {
    for (const auto measure : {StressMeasure::rate_of_deformation, StressMeasure::rate_of_strain})
      forms.push_back({scheme.name, measure});
  }
  return forms;
}

std::string test_name(const ViscousForm& form) {
  return form.scheme +
         (form.measure == StressMeasure::rate_of_strain ? "_rate_of_strain" : "_rate_of_deformation");
}

std::ostream& operator<<(std::ostream& out, const ViscousForm& form) {
  return out << test_name(form);
}

ViscousParameters soft() {
  ViscousParameters parameters;
  parameters.shear_viscosity = 2;
  parameters.dilatational_viscosity = 3;
  parameters.shear_spring = 0.7;
  parameters.dilatational_spring = 0.4;
  return parameters;
}

Membrane viscous_membrane(const TriangleMesh& mesh, const ViscousParameters& parameters, int threads) {
  return {mesh, skalak(), std::make_shared<const ViscousLaw>(parameters), threads};
}

Eigen::Matrix3Xd moved(const TriangleMesh& mesh, int step) {
  return mesh.points + std::sin(0.1 * step) * (smoothly_deformed(mesh.points) - mesh.points);
}

Eigen::Matrix3Xd viscous_forces(Membrane& membrane, const Eigen::Matrix3Xd& positions) {
  Eigen::Matrix3Xd force = forces(membrane, positions);
  Eigen::Matrix3Xd elastic = Eigen::Matrix3Xd::Zero(3, positions.cols());
  membrane.add_elastic_forces(elastic);
  return force - elastic;
}

Eigen::Matrix3Xd strains(const TriangleMesh& reference, const Eigen::Matrix3Xd& positions) {
  Eigen::Matrix3Xd result(3, reference.triangles.cols());
  for (Eigen::Index t = 0; t < result.cols(); ++t) {
    const Eigen::Vector3i nodes = reference.triangles.col(t);
    const auto element = reference_element(corners_of(reference.points, nodes));
    const auto c = cauchy_green(deformation_gradient(corners_of(positions, nodes), element));
    result.col(t) << 0.5 * (c.xx - 1.0), 0.5 * c.xy, 0.5 * (c.yy - 1.0);
  }
  return result;
}

SymmetricTensor tensor(const Eigen::Vector3d& strain) {
  return {strain[0], strain[1], strain[2]};
}

ElementHistories element_histories(const Membrane& membrane) {
  const auto history = membrane.history();
  const Eigen::Index n_elements = membrane.n_triangles();
  // After the normals and the steps since the last update: stress, last strain and sum of strains.
  const Eigen::Map<const Eigen::Matrix<double, 9, Eigen::Dynamic>> elements(
      history.data() + 3 * n_elements + 1, 9, n_elements);
  return {elements.topRows<3>(), elements.middleRows<3>(3)};
}

bool bounds_hold(const Membrane& membrane, const Eigen::Matrix3Xd& strain_increments) {
  const auto stretches = membrane.element_fields().principal_stretches;
  return stretches.minCoeff() > 0.8 && stretches.maxCoeff() < 1.2 &&
         strain_increments.cwiseAbs().maxCoeff() < 0.1;
}

}  // namespace tanktread::membrane::test

namespace tanktread::membrane {

std::ostream& operator<<(std::ostream& out, const MaxwellScheme& scheme) {
  return out << scheme.name;
}

}  // namespace tanktread::membrane
