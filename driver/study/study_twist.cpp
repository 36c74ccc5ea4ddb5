#include "driver/study/study_twist.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <memory>
#include <span>

#include "coupler/coupler.hpp"
#include "driver/study/study_check.hpp"
#include "driver/study/twisting_sphere.hpp"
#include "membrane/element.hpp"
#include "membrane/interfacial_tension.hpp"
#include "membrane/membrane.hpp"
#include "membrane/viscous_law.hpp"

namespace tanktread::driver {
namespace {

using Components = std::array<double, 3>;  ///< theta-phi, theta-theta, phi-phi

void require_valid(const TwistStudy& study) {
  require_positive("amplitude", study.amplitude);
  require_positive("viscosity", study.viscosity);
  require_positive("stiffness", study.stiffness);
  require(study.period >= 4, fmt::format("period is {} steps, must be 4 or more", study.period));
  require(Eigen::Vector3d(study.axis.data()).norm() > 0 && std::isfinite(study.angle_deg),
          "the axis must not be zero, and the angle must be finite");
  require(!study.schemes.empty(), "a scheme is needed");
  for (const double time : study.times) {
    require(std::isfinite(time) && time * study.period >= 0.5,
            fmt::format("time is {} periods, must be one step or more", time));
    require(time * study.period <= TwistStudy::most_steps,
            fmt::format("time is {} periods of {} steps, which makes more than {:g} steps; lower one of them",
                        time, study.period, TwistStudy::most_steps));
  }
}

/// Moves all nodes one time step on.
class Motion {
 public:
  Motion(const TwistStudy& study, const TwistingSphere& sphere, const Eigen::Matrix3Xd& start)
      : approach_(study.approach), sphere_(sphere), box_(study.box), start_(start), velocity_(start) {
    if (approach_ == TwistApproach::surface) return;
    const coupler::Grid grid{{box_, box_, box_}, {false, false, false}};
    coupler_ = std::make_unique<coupler::Coupler>(grid, coupler::kernel(study.kernel), 1);
  }

  /// From the step before `step` to it.
  void advance(Eigen::Matrix3Xd& positions, int step) {
    if (approach_ == TwistApproach::surface) {
      positions = sphere_.twisted(start_, step);
    } else {
      positions += interpolated(positions, step - 1);
    }
  }

 private:
  const Eigen::Matrix3Xd& interpolated(const Eigen::Matrix3Xd& positions, double time) {
    const std::span<const double> surface(positions.data(), positions.size());
    coupler_->build({&surface, 1});
    const auto nodes = coupler_->grid_nodes();
    grid_velocity_.resize(3, nodes.size());
    for (std::size_t k = 0; k < nodes.size(); ++k)
      grid_velocity_.col(k) = sphere_.velocity(place(nodes[k]), time);
    const std::span<double> target(velocity_.data(), velocity_.size());
    coupler_->interpolate({grid_velocity_.data(), static_cast<std::size_t>(grid_velocity_.size())},
                          {&target, 1});
    return velocity_;
  }

  /// Where a grid node is, by its linear index.
  Eigen::Vector3d place(std::int64_t node) const {
    return {node % box_ + 0.5, node / box_ % box_ + 0.5, static_cast<double>(node / box_ / box_) + 0.5};
  }

  TwistApproach approach_;
  const TwistingSphere& sphere_;
  int box_;
  Eigen::Matrix3Xd start_, velocity_, grid_velocity_;
  std::unique_ptr<coupler::Coupler> coupler_;  ///< null in the approach `surface`
};

membrane::TriangleMesh turned_mesh(const TwistStudy& study, const Eigen::Vector3d& centre) {
  membrane::TriangleMesh mesh = membrane::icosphere(study.level, study.radius);
  const Eigen::AngleAxisd turn(study.angle_deg * std::numbers::pi / 180.0,
                               Eigen::Vector3d(study.axis.data()).normalized());
  mesh.points = (turn.toRotationMatrix() * mesh.points).colwise() + centre;
  return mesh;
}

/// A membrane for each scheme. Their elastic law takes no part: elements answer for their viscous stress
/// apart.
std::vector<membrane::Membrane> membranes_of(const TwistStudy& study, const membrane::TriangleMesh& mesh) {
  membrane::ElasticParameters elastic;
  elastic.interfacial_tension = 1.0;
  const std::shared_ptr<const membrane::ElasticLaw> law = membrane::make_interfacial_tension(elastic);
  std::vector<membrane::Membrane> membranes;
  for (const auto& scheme : study.schemes) {
    membrane::ViscousParameters viscous;
    viscous.scheme = scheme;
    viscous.shear_viscosity = 0.5 * study.viscosity;
    viscous.shear_spring = study.stiffness;
    viscous.dilatational_viscosity = study.dilatational_ratio * viscous.shear_viscosity;
    viscous.dilatational_spring = study.dilatational_ratio * viscous.shear_spring;
    viscous.measure = study.measure;
    membranes.emplace_back(mesh, law, std::make_shared<membrane::ViscousLaw>(viscous), 1);
  }
  return membranes;
}

Eigen::Matrix3d corners_of(const membrane::TriangleMesh& mesh, const Eigen::Matrix3Xd& positions,
                           Eigen::Index element) {
  return positions(Eigen::all, mesh.triangles.col(element));
}

/// Strain rate of an element in space, from its Green strains a time step apart: the backward difference that
/// the law sees, carried by the polar rotation of the present.
Eigen::Matrix3d strain_rate(const membrane::ReferenceElement& reference, const Eigen::Matrix3d& before,
                            const Eigen::Matrix3d& now, membrane::StressMeasure measure) {
  const auto gradient = membrane::deformation_gradient(now, reference);
  const auto c = membrane::cauchy_green(gradient);
  const auto c_before = membrane::cauchy_green(membrane::deformation_gradient(before, reference));
  auto rate = 0.5 * (c - c_before);
  if (measure == membrane::StressMeasure::rate_of_deformation) {
    rate = membrane::on_both_sides(membrane::right_stretch(0.5 * (c + c_before)).inverse, rate);
  }
  const auto rotation = membrane::polar_rotation(gradient, membrane::right_stretch(c));
  return rotation * rate.matrix() * rotation.transpose();
}

/// Adds the squares of the components of `tensor`, whose theta-phi component should be `exact` and the others
/// zero.
void add_squares(const Eigen::Matrix3d& tensor, const SphericalFrame& frame, double exact, Components& sums) {
  sums[0] += std::pow(frame.e_theta.dot(tensor * frame.e_phi) - exact, 2);
  sums[1] += std::pow(frame.e_theta.dot(tensor * frame.e_theta), 2);
  sums[2] += std::pow(frame.e_phi.dot(tensor * frame.e_phi), 2);
}

Components root_mean(Components sums, Eigen::Index n, double scale) {
  for (double& sum : sums) sum = std::sqrt(sum / static_cast<double>(n)) / scale;
  return sums;
}

Components strain_rate_errors(const TwistStudy& study, const TwistingSphere& sphere,
                              const membrane::TriangleMesh& mesh, const Eigen::Matrix3Xd& before,
                              const Eigen::Matrix3Xd& now, double time) {
  Components sums{};
  for (Eigen::Index t = 0; t < mesh.triangles.cols(); ++t) {
    const auto reference = membrane::reference_element(corners_of(mesh, mesh.points, t));
    const Eigen::Matrix3d corners = corners_of(mesh, now, t);
    const auto rate = strain_rate(reference, corners_of(mesh, before, t), corners, study.measure);
    const auto frame = sphere.frame(corners.rowwise().mean());
    add_squares(rate, frame, sphere.shear_rate(frame.polar_angle, time), sums);
  }
  return root_mean(sums, mesh.triangles.cols(), sphere.nominal_strain_rate());
}

Components stress_errors(const TwistStudy& study, const TwistingSphere& sphere,
                         const membrane::Membrane& membrane, double time) {
  const auto& mesh = membrane.reference();
  const auto stress = membrane.element_fields().viscous_stress;
  Components sums{};
  for (Eigen::Index t = 0; t < mesh.triangles.cols(); ++t) {
    const auto frame = sphere.frame(corners_of(mesh, membrane.positions(), t).rowwise().mean());
    const double exact =
        sphere.shear_stress(frame.polar_angle, time, study.viscosity, study.viscosity / study.stiffness);
    add_squares(stress.col(t).reshaped(3, 3), frame, exact, sums);
  }
  return root_mean(sums, mesh.triangles.cols(), study.viscosity * sphere.nominal_strain_rate());
}

std::vector<int> reading_steps(const TwistStudy& study) {
  std::vector<int> steps;
  for (const double time : study.times) steps.push_back(static_cast<int>(std::lround(time * study.period)));
  std::sort(steps.begin(), steps.end());
  return steps;
}

std::string approach_name(TwistApproach approach) {
  return approach == TwistApproach::surface ? "surface" : "flow";
}

}  // namespace

std::vector<TwistErrors> twist_errors(const TwistStudy& study) {
  require_valid(study);
  const Eigen::Vector3d centre = Eigen::Vector3d(study.offset.data()).array() + 0.5 * study.box;
  const TwistingSphere sphere{centre, study.radius, study.amplitude, study.period};
  const auto mesh = turned_mesh(study, sphere.centre);
  auto membranes = membranes_of(study, mesh);
  Motion motion(study, sphere, mesh.points);
  Eigen::Matrix3Xd positions = mesh.points, before = positions, force(3, positions.cols());
  std::vector<TwistErrors> errors;
  int step = 0;
  for (const int reading : reading_steps(study)) {
    for (; step < reading; ++step) {
      before = positions;
      motion.advance(positions, step + 1);
      for (auto& membrane : membranes) {
        membrane.set_positions(positions);
        membrane.add_forces(force.setZero());  // takes the strain into the history
      }
    }
    const auto strain_rate = strain_rate_errors(study, sphere, mesh, before, positions, step);
    for (std::size_t k = 0; k < membranes.size(); ++k)
      errors.push_back({step / study.period, study.schemes[k], strain_rate,
                        stress_errors(study, sphere, membranes[k], step)});
  }
  return errors;
}

std::string twist_table(const std::vector<TwistStudy>& studies) {
  constexpr std::array names = {"theta-phi", "theta-theta", "phi-phi"};
  std::string table =
      "approach,n_triangles,radius,axis,angle_deg,kernel,scheme,t_over_T0,component,strain_rate,stress\n";
  for (const auto& study : studies) {
    for (const auto& errors : twist_errors(study)) {
      for (std::size_t k = 0; k < names.size(); ++k) {
        table +=
            fmt::format("{},{},{},{} {} {},{},{},{},{:.6g},{},{:.7g},{:.7g}\n", approach_name(study.approach),
                        20 << (2 * study.level), study.radius, study.axis[0], study.axis[1], study.axis[2],
                        study.angle_deg, study.approach == TwistApproach::flow ? study.kernel : "",
                        errors.scheme, errors.time, names[k], errors.strain_rate[k], errors.stress[k]);
      }
    }
  }
  return table;
}

}  // namespace tanktread::driver
