#include "fluid/node_rates.hpp"

#include <algorithm>
#include <new>

#include "fluid/settings.hpp"

namespace tanktread::fluid {

template <typename Real>
NodeRates<Real>::NodeRates(const LatticeBoltzmannSettings& settings, const GridShape& shape)
    : settings_(settings),
      shape_(shape),
      base_viscosity_(viscosity_of(settings)),
      packs_a_row_((shape.nx + pack_size<Real> - 1) / pack_size<Real>),
      n_packs_(packs_a_row_ * shape.ny * shape.nz) {
  known_.fill(rates_of(0.0));
}

template <typename Real>
void NodeRates<Real>::set(std::span<const std::int64_t> nodes, std::span<const double> viscosity) {
  if (nodes.empty()) return;
  prepare();
  for (std::size_t k = 0; k < nodes.size(); ++k) viscosity_[nodes[k]] = kept(viscosity[k]);
  const std::int64_t nx = shape_.nx;
  // Nodes that follow each other in a pack are met together; to meet a pack again would change nothing.
  std::int64_t last_pack = -1;
  for (const std::int64_t node : nodes) {
    const std::int64_t pack = node / nx * packs_a_row_ + node % nx / pack_size<Real>;
    if (pack != last_pack) classify(pack);
    last_pack = pack;
  }
}

template <typename Real>
void NodeRates<Real>::set_all(std::span<const double> viscosity) {
  if (viscosity.empty()) {
    class_of_.clear();
    viscosity_.reset();
    of_mixed_.reset();
    packs_of_known_.fill(0);
    return;
  }
  begin_set_all();
  set_rows(0, viscosity);
}

template <typename Real>
void NodeRates<Real>::begin_set_all() {
  prepare();
}

template <typename Real>
void NodeRates<Real>::set_rows(std::int64_t first_row, std::span<const double> viscosity) {
  const std::int64_t first_node = first_row * shape_.nx, n_rows = std::ssize(viscosity) / shape_.nx;
  for (std::size_t k = 0; k < viscosity.size(); ++k) {
    double& of_node = viscosity_[first_node + static_cast<std::int64_t>(k)];
    const double value = kept(viscosity[k]);
    if (of_node != value) of_node = value;  // to read takes no memory
  }
  for (std::int64_t pack = first_row * packs_a_row_; pack < (first_row + n_rows) * packs_a_row_; ++pack)
    classify(pack);
}

template <typename Real>
void NodeRates<Real>::viscosity(std::int64_t first_node, std::span<double> viscosity) const {
  std::ranges::fill(viscosity, base_viscosity_);
  if (!is_set()) return;
  for (std::size_t k = 0; k < viscosity.size(); ++k) {
    const double of_node = viscosity_[first_node + static_cast<std::int64_t>(k)];
    if (of_node != 0.0) viscosity[k] = of_node;
  }
}

template <typename Real>
std::int64_t NodeRates<Real>::n_mixed() const {
  return std::ranges::count(class_of_, mixed);
}

template <typename Real>
void NodeRates<Real>::prepare() {
  if (is_set()) return;
  const auto n_nodes = static_cast<std::size_t>(shape_.size());
  std::unique_ptr<double[], Release> viscosity(static_cast<double*>(std::calloc(n_nodes, sizeof(double))));
  if (!viscosity) throw std::bad_alloc();
  auto of_mixed = std::make_unique_for_overwrite<Rates<Real>[]>(n_packs_);
  class_of_.assign(n_packs_, 0);
  viscosity_ = std::move(viscosity);
  of_mixed_ = std::move(of_mixed);
  packs_of_known_[0] = n_packs_;
}

/// Finds the class of a pack anew, from the viscosities of its nodes.
template <typename Real>
void NodeRates<Real>::classify(std::int64_t pack) {
  const std::int64_t nx = shape_.nx;
  const std::int64_t row = pack / packs_a_row_, x = pack % packs_a_row_ * pack_size<Real>;
  const std::span<const double> of_nodes(&viscosity_[row * nx + x],
                                         std::min<std::int64_t>(pack_size<Real>, nx - x));
  const bool all_the_same =
      std::ranges::all_of(of_nodes, [&](double viscosity) { return viscosity == of_nodes[0]; });
  // Given back first: a pack may be the last of its class, whose place it then can have.
  if (class_of_[pack] != mixed) --packs_of_known_[class_of_[pack]];
  class_of_[pack] = all_the_same ? class_for(of_nodes[0]) : mixed;
  if (class_of_[pack] == mixed) {
    fill_mixed(pack, of_nodes);
  } else {
    ++packs_of_known_[class_of_[pack]];
  }
}

/// The number of a viscosity in the table, where it is put if it is not there; `mixed` if there is no room.
template <typename Real>
typename NodeRates<Real>::Class NodeRates<Real>::class_for(double viscosity) {
  if (viscosity == 0.0) return 0;
  int free = n_known;
  for (int number = n_known - 1; number > 0; --number) {
    if (packs_of_known_[number] == 0) {
      free = number;
    } else if (known_viscosity_[number] == viscosity) {
      return static_cast<Class>(number);
    }
  }
  if (free == n_known) return mixed;
  known_viscosity_[free] = viscosity;
  known_[free] = rates_of(viscosity);
  return static_cast<Class>(free);
}

template <typename Real>
void NodeRates<Real>::fill_mixed(std::int64_t pack, std::span<const double> viscosity) {
  auto& rates = of_mixed_[pack];
  auto of_node = rates_of(viscosity[0]);
  for (int lane = 0; lane < pack_size<Real>; ++lane) {
    const bool another = lane > 0 && lane < std::ssize(viscosity) && viscosity[lane] != viscosity[lane - 1];
    if (another) of_node = rates_of(viscosity[lane]);
    rates.even[lane] = of_node.even[lane];
    rates.odd[lane] = of_node.odd[lane];
  }
}

/// @param viscosity as kept
template <typename Real>
Rates<Real> NodeRates<Real>::rates_of(double viscosity) const {
  // To the last bit what the settings' viscosity would give: tau+ - 1/2 is exact, and so is 3 (x/3) = x.
  const double relaxation_time =
      viscosity == 0.0 ? settings_.relaxation_time : 0.5 + d3q19::inverse_sound_speed_squared * viscosity;
  return {pack_of(static_cast<Real>(1.0 / relaxation_time)),
          pack_of(static_cast<Real>(1.0 / odd_relaxation_time(settings_, relaxation_time)))};
}

template class NodeRates<double>;
template class NodeRates<float>;

}  // namespace tanktread::fluid
