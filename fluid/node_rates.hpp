// The relaxation rates of every node, uniform or from a viscosity of its own. Internal to fluid/.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "fluid/collision.hpp"
#include "fluid/settings.hpp"

namespace tanktread::fluid {

template <typename Real>
class NodeRates {
 public:
  explicit NodeRates(const LatticeBoltzmannSettings& settings)
      : settings_(settings),
        even_rate_(static_cast<Real>(1.0 / settings.relaxation_time)),
        odd_rate_(static_cast<Real>(1.0 / odd_relaxation_time(settings, settings.relaxation_time))) {}

  /// Kinematic viscosity of every node; none: that of the settings everywhere.
  void set_viscosity(std::span<const double> viscosity) {
    viscosity_.assign(viscosity.begin(), viscosity.end());
    even_.resize(viscosity.size());
    odd_.resize(viscosity.size());
    for (std::size_t node = 0; node < viscosity.size(); ++node) {
      const double relaxation_time = 0.5 + d3q19::inverse_sound_speed_squared * viscosity[node];
      even_[node] = static_cast<Real>(1.0 / relaxation_time);
      odd_[node] = static_cast<Real>(1.0 / odd_relaxation_time(settings_, relaxation_time));
    }
  }
  const std::vector<double>& viscosity() const { return viscosity_; }

  bool uniform() const { return even_.empty(); }

  /// Of every node, if they are uniform.
  Rates<Real> of_all() const { return {pack_of(even_rate_), pack_of(odd_rate_)}; }

  /// Of nodes that follow each other, if they are not uniform; lanes beyond the last repeat it: any that is
  /// finite would do.
  Rates<Real> pack(std::int64_t node, int n_lanes) const {
    if (n_lanes == pack_size<Real>) return {load(&even_[node]), load(&odd_[node])};
    Rates<Real> rates;
    for (int lane = 0; lane < pack_size<Real>; ++lane) {
      rates.even[lane] = even_[node + std::min(lane, n_lanes - 1)];
      rates.odd[lane] = odd_[node + std::min(lane, n_lanes - 1)];
    }
    return rates;
  }

 private:
  LatticeBoltzmannSettings settings_;
  Real even_rate_, odd_rate_;
  std::vector<double> viscosity_;  ///< empty unless set
  std::vector<Real> even_, odd_;   ///< empty unless set
};

}  // namespace tanktread::fluid
