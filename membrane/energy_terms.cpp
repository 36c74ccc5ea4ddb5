#include "membrane/energy_terms.hpp"

#include <algorithm>
#include <stdexcept>

namespace tanktread::membrane {

EnergyTerms::EnergyTerms(const TriangleMesh& reference, const std::vector<EnergyChoice>& choices, int threads)
    : surface_(reference, threads) {
  for (const auto& [name, parameters] : choices) {
    if (std::ranges::find(names_, name) != names_.end())
      throw std::invalid_argument("energy terms: " + name + " is named twice; add up its moduli");
    names_.push_back(name);
    terms_.push_back(make_energy_term(name, surface_.measures(), parameters));
    any_depends_on_curvature_ |= terms_.back()->depends_on_curvature();
  }
  derivatives_.triangle_area.resize(surface_.n_triangles());
  derivatives_.node_area.resize(surface_.n_nodes());
  derivatives_.node_curvature.resize(surface_.n_nodes());
}

std::vector<double> EnergyTerms::energies(const Eigen::Matrix3Xd& positions) {
  const auto& measures = surface_.measure(positions, any_depends_on_curvature_);
  std::vector<double> energies;
  for (const auto& term : terms_) energies.push_back(term->energy(measures));
  return energies;
}

double EnergyTerms::energy(const Eigen::Matrix3Xd& positions) {
  const auto& measures = surface_.measure(positions, any_depends_on_curvature_);
  double sum = 0;
  for (const auto& term : terms_) sum += term->energy(measures);
  return sum;
}

void EnergyTerms::derive() {
  const auto& measures = surface_.add_up(any_depends_on_curvature_);
  derivatives_.set_zero();
  for (const auto& term : terms_) term->add_derivatives(measures, derivatives_);
}

void EnergyTerms::add_forces(const Eigen::Matrix3Xd& positions, Eigen::Ref<Eigen::Matrix3Xd> force) {
  if (terms_.empty()) return;
  const auto& measures = surface_.measure(positions, any_depends_on_curvature_);
  derivatives_.set_zero();
  for (const auto& term : terms_) term->add_derivatives(measures, derivatives_);
  surface_.add_forces(derivatives_, force);
}

void EnergyTerms::add_forces_of(std::size_t k, const Eigen::Matrix3Xd& positions,
                                Eigen::Ref<Eigen::Matrix3Xd> force) {
  const EnergyTerm& term = *terms_.at(k);
  const auto& measures = surface_.measure(positions, term.depends_on_curvature());
  derivatives_.set_zero();
  term.add_derivatives(measures, derivatives_);
  surface_.add_forces(derivatives_, force);
}

}  // namespace tanktread::membrane
