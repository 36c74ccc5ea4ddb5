// What the tests of membrane viscosity share: every form of the law, a membrane with it, a motion, and what
// the membrane remembers of its elements.
#pragma once

#include <Eigen/Core>
#include <ostream>
#include <string>
#include <vector>

#include "membrane/maxwell.hpp"
#include "membrane/symmetric_tensor.hpp"
#include "membrane/viscous_parameters.hpp"
#include "unit/membrane_support.hpp"

namespace tanktread::membrane::test {

/// A scheme of maxwell_schemes() and a stress measure.
struct ViscousForm {
  std::string scheme;
  StressMeasure measure;
};
/// Every scheme of the library with every measure.
std::vector<ViscousForm> viscous_forms();
/// How GoogleTest names and prints one.
std::string test_name(const ViscousForm& form);
std::ostream& operator<<(std::ostream& out, const ViscousForm& form);

/// Springs that relax within a few steps, so that the history counts.
ViscousParameters soft();

/// With the law of skalak().
Membrane viscous_membrane(const TriangleMesh& mesh, const ViscousParameters& parameters, int threads = 1);

/// A motion of finite strain without any symmetry, smooth in time; at rest at step 0.
Eigen::Matrix3Xd moved(const TriangleMesh& mesh, int step);

/// Takes the time step to these positions. @return the viscous part of the forces
Eigen::Matrix3Xd viscous_forces(Membrane& membrane, const Eigen::Matrix3Xd& positions);

/// Green strains E11, E12, E22, a column an element.
Eigen::Matrix3Xd strains(const TriangleMesh& reference, const Eigen::Matrix3Xd& positions);
/// The strain of a column as a tensor.
SymmetricTensor tensor(const Eigen::Vector3d& strain);

/// What Membrane::history() has of the elements, a column an element (ViscousHistory::append_to()).
struct ElementHistories {
  Eigen::Matrix3Xd stress;       ///< the components of ViscousState, in the frame of R
  Eigen::Matrix3Xd last_strain;  ///< E11, E12, E22 at the last update
};
ElementHistories element_histories(const Membrane& membrane);

// Bounds of what differs by rounding between two membranes that see the same strains, one perhaps turned, in
// units of r = gradient_rounding(), with the springs of soft(), where bounds_hold().

/// Strain: an entry of E = (F^T F - I)/2 changes by sqrt(3) 1.2 times what an entry of F does. That is r, and
/// 2 r with coordinates that a rotation has rounded three times more: 6.3 r between the two. The products of
/// F^T F and the rotation's own rounding are below r.
constexpr double strain_roundings = 8;

/// Stress, each update: an increment of E has twice the strain's, as a 2 x 2 matrix the norm 32 r. U^-1 on
/// both sides makes at most 1/0.8^2 of that, 50 r. U itself changes by |dC|/(2 x 0.8) = 20 r, so U^-1 by 31
/// r, and twice that times 1/0.8 times the increment (0.2) is 16 r. In every scheme the gain is below k' =
/// 0.7, and what was there before is multiplied by a decay of size below 1.
constexpr double stress_roundings = 50;

/// The stretches are between 0.8 and 1.2, and no entry of the strain increments of an update is above 0.1.
bool bounds_hold(const Membrane& membrane, const Eigen::Matrix3Xd& strain_increments);

}  // namespace tanktread::membrane::test

namespace tanktread::membrane {

/// How GoogleTest prints a scheme.
std::ostream& operator<<(std::ostream& out, const MaxwellScheme& scheme);

}  // namespace tanktread::membrane
