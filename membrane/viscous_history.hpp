// What a membrane remembers of its elements for their viscous law.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "membrane/symmetric_tensor.hpp"
#include "membrane/viscous_law.hpp"

namespace tanktread::membrane {

/// Viscous stress of each element, with what its next update needs. The owner calls begin_step() once a time
/// step, then take() once for every element, in any order and from any thread.
class ViscousHistory {
 public:
  /// All elements at rest: strain and stress zero, as with begin_at() of no strain.
  ViscousHistory(std::shared_ptr<const ViscousLaw> law, Eigen::Index n_elements);

  const ViscousLaw& law() const { return *law_; }

  /// An element begins anew at a Green strain E, without stress. To be called for all elements.
  void begin_at(Eigen::Index element, const SymmetricTensor& strain) {
    elements_[element] = Element();
    elements_[element].last_strain = strain;
    steps_since_update_ = 0;
  }

  /// Counts the time step whose strains take() is about to be given: every Nth one updates the stresses. No
  /// thread may be in take().
  void begin_step();

  /// Takes the Green strain E of an element at the new time. In every Nth step its stress goes on with the
  /// law; in the steps between, it is kept (in the frame that turns with the element).
  void take(Eigen::Index element, const SymmetricTensor& strain) {
    Element& self = elements_[element];
    // A sum that starts anew with the first step after an update; one number after the other, so that with
    // N = 1 the mean is the latest strain to the last bit.
    self.strain_sum = steps_since_update_ == 1 ? strain : self.strain_sum + strain;
    if (steps_since_update_ < law_->interval()) return;
    const SymmetricTensor sample =
        law_->sampling() == StrainSampling::latest ? strain : mean(self.strain_sum);
    law_->advance(self.last_strain, sample, self.stress);
    self.last_strain = sample;
  }

  /// Viscous Cauchy stress of an element in the frame of its polar rotation R, force per length.
  SymmetricTensor stress(Eigen::Index element) const { return ViscousLaw::stress(elements_[element].stress); }

  /// Numbers that append_to() appends: one, and nine an element.
  std::size_t n_values() const { return 9 * elements_.size() + 1; }

  /// Everything a restart needs, appended: steps since the last update, then of each element the state of its
  /// stress, the strain of the last update and the sum of the strains since, the last two as E11, E12, E22.
  void append_to(std::vector<double>& values) const;

  /// @param values n_values() numbers as append_to() gave them
  /// @throws std::invalid_argument if the number of steps since the last update is none of 0 to N
  void restore(std::span<const double> values);

 private:
  struct Element {
    ViscousState stress{};
    SymmetricTensor last_strain;  ///< that entered the last update
    SymmetricTensor strain_sum;   ///< of the steps since, for the moving average
  };

  SymmetricTensor mean(const SymmetricTensor& sum) const {
    const double n = law_->interval();
    return {sum.xx / n, sum.xy / n, sum.yy / n};
  }

  std::shared_ptr<const ViscousLaw> law_;
  std::vector<Element> elements_;
  int steps_since_update_ = 0;
};

}  // namespace tanktread::membrane
