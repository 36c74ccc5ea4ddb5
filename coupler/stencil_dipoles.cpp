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
    const std::size_t needed = 3 * stencils.nodes.n_nodes_of_surface[s];
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
  for (const ShearDipole& dipole : dipoles) stencils.dipoles.push_back({{}, dipole.length});
  SurfaceOfNode surface(stencils.nodes);
  for (std::size_t m = 0; m < stencils.n_nodes(); ++m) {
    const std::size_t s = surface.of(m), node = surface.node(m);
    if (dipoles[s].length == 0) continue;
    const auto normal = dipoles[s].normals.subspan(3 * node, 3);
    if (!std::ranges::all_of(normal, [](double number) { return std::isfinite(number); })) {
      throw StencilError("coupler: surface " + std::to_string(s) + ", node " + std::to_string(node) +
                             ": its normal, which the shear dipole needs, is not finite",
                         precedence_of(StencilFault::normal, s, node));
    }
    std::ranges::copy(normal, stencils.normals.begin() + static_cast<std::ptrdiff_t>(3 * m));
  }
}

}  // namespace tanktread::coupler
