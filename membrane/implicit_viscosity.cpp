#include "membrane/implicit_viscosity.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace tanktread::membrane {
namespace {

double relaxation_time(const std::string& name, double time) {
  if (std::isfinite(time) && time >= 0) return time;
  throw std::invalid_argument("implicit viscosity: " + name + " is " + std::to_string(time) +
                              ", must be 0 or positive");
}

}  // namespace

ImplicitViscosity::ImplicitViscosity(Eigen::Matrix3Xi triangles, Eigen::Index n_nodes,
                                     const ImplicitParameters& parameters, int threads)
    : rates_(std::move(triangles), n_nodes, parameters.shear_viscosity, parameters.dilatational_viscosity,
             parameters.rates_at, threads) {
  const double shear = relaxation_time("shear_relaxation", parameters.shear_relaxation);
  theta_ = {shear, shear, relaxation_time("dilatational_relaxation", parameters.dilatational_relaxation)};
  stress_ = stress_before_ = Eigen::Matrix3Xd::Zero(3, rates_.n_rates());
}

void ImplicitViscosity::set_positions(const Eigen::Ref<const Eigen::Matrix3Xd>& positions) {
  rates_.set_positions(positions);
  if (has_positions_ && (theta_ > 0).any()) {
    rates_.carry(stress_);
    rates_.carry(stress_before_);
  }
  has_positions_ = true;
}

void ImplicitViscosity::add_memory(Eigen::Ref<Eigen::Matrix3Xd> numbers) const {
  numbers.array() += stress_.array().colwise() * theta_;
}

void ImplicitViscosity::add_diagonal(const Eigen::Ref<const Eigen::Matrix3Xd>& stress,
                                     Eigen::Ref<Eigen::Matrix3Xd> numbers) const {
  numbers.array() += stress.array().colwise() * (1 + theta_);
}

void ImplicitViscosity::accept(const Eigen::Ref<const Eigen::Matrix3Xd>& stress) {
  if (stress.cols() != stress_.cols()) {
    throw std::invalid_argument("implicit viscosity: a stress of " + std::to_string(stress.cols()) +
                                " columns, must have " + std::to_string(stress_.cols()));
  }
  stress_before_.swap(stress_);
  stress_ = stress;
}

Eigen::Matrix3Xd ImplicitViscosity::stress_of(const Eigen::Ref<const Eigen::Matrix3Xd>& velocity) const {
  Eigen::Matrix3Xd result(3, rates_.n_rates());
  rates_.multiply(velocity, result);
  add_memory(result);
  result.array().colwise() /= 1 + theta_;
  return result;
}

ViscousPower ImplicitViscosity::power(const Eigen::Ref<const Eigen::Matrix3Xd>& velocity) const {
  Eigen::Matrix3Xd rates(3, rates_.n_rates());
  rates_.multiply(velocity, rates);
  Eigen::Array3d dissipated = Eigen::Array3d::Zero(), taken_up = Eigen::Array3d::Zero();
  for (Eigen::Index k = 0; k < stress_.cols(); ++k) {
    dissipated += stress_.col(k).array().square();
    taken_up += stress_.col(k).array() * (rates.col(k) - stress_.col(k)).array();
  }
  double spring = 0;
  for (int part = 0; part < 3; ++part) spring += theta_[part] > 0 ? taken_up[part] : 0;
  return {dissipated[0] + dissipated[1], dissipated[2], spring};
}

void ImplicitViscosity::append_to(std::vector<double>& values) const {
  for (const auto* stress : {&stress_, &stress_before_})
    values.insert(values.end(), stress->data(), stress->data() + stress->size());
}

void ImplicitViscosity::restore(std::span<const double> values) {
  if (values.size() != n_values()) {
    throw std::invalid_argument("implicit viscosity: a history of " + std::to_string(values.size()) +
                                " numbers, " + std::to_string(n_values()) + " are needed");
  }
  const std::size_t n_numbers = values.size() / 2;
  std::copy_n(values.begin(), n_numbers, stress_.data());
  std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(n_numbers), n_numbers, stress_before_.data());
}

}  // namespace tanktread::membrane
