// Capsules at a time, as what looks at them sees them.
#pragma once

#include <cstdint>
#include <span>

#include "driver/system/phases.hpp"
#include "driver/system/system.hpp"

namespace tanktread::driver {

/// All capsules of a case at time t = `step`, or some of them. All is borrowed.
struct CapsulesNow {
  std::span<const CapsuleMembrane> membranes;
  std::span<const Eigen::Matrix3Xd> velocity;  ///< u_m(t-1) of each, which moved the nodes to x(t)
  std::span<const Eigen::Matrix3Xd> force;     ///< of each, the total force at x(t)
  CapsuleNumbers numbers;                      ///< of each, in the case; none: they follow one another
  std::size_t first_number = 0;                ///< of the first one then
  std::int64_t step = 0;
  double shear_rate = 0;

  double shear_time() const { return static_cast<double>(step) * shear_rate; }
  /// In the case. @param k of those here
  std::size_t number(std::size_t k) const { return numbers.empty() ? first_number + k : numbers[k]; }
  /// `n` of them from the one at `first` on.
  CapsulesNow some(std::size_t first, std::size_t n) const {
    return {membranes.subspan(first, n),
            velocity.subspan(first, n),
            force.subspan(first, n),
            numbers.empty() ? CapsuleNumbers() : numbers.subspan(first, n),
            first_number + first,
            step,
            shear_rate};
  }
};

/// Those of a system.
inline CapsulesNow capsules_now(const System& system) {
  return {system.membranes, system.node_velocity, system.node_force, {}, 0, system.step, system.shear_rate};
}

}  // namespace tanktread::driver
