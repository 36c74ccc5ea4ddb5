#include "membrane/viscous_history.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

namespace tanktread::membrane {
namespace {

Eigen::Matrix2d symmetric(const std::array<double, 3>& components) {
  Eigen::Matrix2d tensor;
  tensor << components[0], components[1], components[1], components[2];
  return tensor;
}

}  // namespace

ViscousHistory::ViscousHistory(std::shared_ptr<const ViscousLaw> law, Eigen::Index n_elements)
    : law_(std::move(law)), elements_(static_cast<std::size_t>(n_elements)) {}

void ViscousHistory::begin_step() {
  if (steps_since_update_ == law_->interval()) steps_since_update_ = 0;
  ++steps_since_update_;
}

void ViscousHistory::take(Eigen::Index element, const Eigen::Matrix2d& strain) {
  Element& self = elements_[element];
  const std::array<double, 3> now = {strain(0, 0), strain(0, 1), strain(1, 1)};
  const int interval = law_->interval();
  // A sum that starts anew with the first step after an update; one number after the other, so that with
  // N = 1 the mean is the latest strain to the last bit.
  for (int k = 0; k < 3; ++k) {
    self.strain_sum[k] = steps_since_update_ == 1 ? now[k] : self.strain_sum[k] + now[k];
  }
  if (steps_since_update_ < interval) return;
  auto sample = now;
  if (law_->sampling() == StrainSampling::moving_average) {
    for (int k = 0; k < 3; ++k) sample[k] = self.strain_sum[k] / interval;
  }
  law_->advance(symmetric(self.last_strain), symmetric(sample), self.stress);
  self.last_strain = sample;
}

void ViscousHistory::append_to(std::vector<double>& values) const {
  values.push_back(steps_since_update_);
  for (const auto& element : elements_) {
    for (const auto* part : {&element.stress, &element.last_strain, &element.strain_sum}) {
      values.insert(values.end(), part->begin(), part->end());
    }
  }
}

void ViscousHistory::restore(std::span<const double> values) {
  const double steps = values[0];
  if (!(steps >= 0 && steps <= law_->interval() && steps == std::floor(steps))) {
    throw std::invalid_argument("membrane: a history with " + std::to_string(steps) +
                                " steps since the last update of the viscous stress, must be 0 to " +
                                std::to_string(law_->interval()));
  }
  steps_since_update_ = static_cast<int>(steps);
  auto next = values.begin() + 1;
  for (auto& element : elements_) {
    for (auto* part : {&element.stress, &element.last_strain, &element.strain_sum}) {
      std::copy_n(next, part->size(), part->begin());
      next += static_cast<std::ptrdiff_t>(part->size());
    }
  }
}

}  // namespace tanktread::membrane
