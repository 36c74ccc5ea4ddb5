// The part of StencilBuilder that takes in shear dipoles.
#include <algorithm>
#include <cmath>
#include <string>

#include "coupler/stencils.hpp"

namespace tanktread::coupler {

void StencilBuilder::check_dipoles(std::span<const ShearDipole> dipoles, const Stencils& stencils) const {
  if (dipoles.empty()) return;
  if (dipoles.size() != stencils.n_surfaces()) {
    throw std::invalid_argument("coupler: " + std::to_string(dipoles.size()) + " shear dipoles for " +
                                std::to_string(stencils.n_surfaces()) + " surfaces");
  }
  for (std::size_t s = 0; s < dipoles.size(); ++s) {
    if (dipoles[s].length == 0) continue;
    const std::size_t needed = 3 * (stencils.first_node[s + 1] - stencils.first_node[s]);
    if (!std::isfinite(dipoles[s].length) || dipoles[s].normals.size() != needed) {
      throw std::invalid_argument("coupler: the shear dipole of surface " + std::to_string(s) +
                                  " has the length " + std::to_string(dipoles[s].length) + " and " +
                                  std::to_string(dipoles[s].normals.size()) + " numbers of normals; " +
                                  std::to_string(needed) + " and a finite length are needed");
    }
    if (kernel_.slopes == nullptr) {
      throw std::invalid_argument("coupler: kernel '" + kernel_.name +
                                  "' has no slopes, which a shear dipole needs");
    }
  }
}

void StencilBuilder::take_dipoles(std::span<const ShearDipole> dipoles, Stencils& stencils) const {
  stencils.dipoles.clear();
  if (std::ranges::all_of(dipoles, [](const ShearDipole& dipole) { return dipole.length == 0; })) return;
  stencils.normals.resize(3 * stencils.n_nodes());
  stencils.slopes.resize(stencils.weights.size());
  for (std::size_t s = 0; s < dipoles.size(); ++s) {
    stencils.dipoles.push_back({{}, dipoles[s].length});
    if (dipoles[s].length == 0) continue;
    const auto normals = dipoles[s].normals;
    const auto lost = std::ranges::find_if_not(normals, [](double number) { return std::isfinite(number); });
    if (lost != normals.end()) {
      throw StencilError("coupler: surface " + std::to_string(s) + ", node " +
                         std::to_string((lost - normals.begin()) / 3) +
                         ": its normal, which the shear dipole needs, is not finite");
    }
    std::ranges::copy(normals,
                      stencils.normals.begin() + static_cast<std::ptrdiff_t>(3 * stencils.first_node[s]));
  }
}

}  // namespace tanktread::coupler
