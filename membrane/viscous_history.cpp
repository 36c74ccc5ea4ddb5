#include "membrane/viscous_history.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

namespace tanktread::membrane {
ViscousHistory::ViscousHistory(std::shared_ptr<const ViscousLaw> law, Eigen::Index n_elements)
    : law_(std::move(law)), elements_(static_cast<std::size_t>(n_elements)) {}

void ViscousHistory::begin_step() {
  if (steps_since_update_ == law_->interval()) steps_since_update_ = 0;
  ++steps_since_update_;
}

void ViscousHistory::append_to(std::vector<double>& values) const {
  values.push_back(steps_since_update_);
  for (const auto& element : elements_) {
    values.insert(values.end(), element.stress.begin(), element.stress.end());
    for (const auto& strain : {element.last_strain, element.strain_sum}) {
      values.insert(values.end(), {strain.xx, strain.xy, strain.yy});
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
  const double* next = values.data() + 1;
  for (auto& element : elements_) {
    std::copy_n(next, element.stress.size(), element.stress.begin());
    next += element.stress.size();
    for (auto* strain : {&element.last_strain, &element.strain_sum}) {
      *strain = {next[0], next[1], next[2]};
      next += 3;
    }
  }
}

}  // namespace tanktread::membrane
