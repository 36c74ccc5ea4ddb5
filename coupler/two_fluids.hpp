// A surface between two fluids: the shear dipole that its stencils need, and what its nodes lose all the
// same.
#pragma once

#include "coupler/coupler.hpp"

namespace tanktread::coupler {

/// Dynamic viscosities on the two sides of a surface, lattice units.
struct SideViscosities {
  double outer, inner;
};

/// The length of the shear dipole (ShearDipole) of a surface between two fluids, where each grid node has the
/// viscosity of the side that it is on, grid steps, positive towards the outside:
///
///     d = 2 m (mu_o - mu_i)/(mu_o + mu_i),    m = <|r + b|>/4
///
/// with the mean over the kernel's r in three dimensions and over the cell of a grid node for b; m is that of
/// |n.(r + b)|/2 over all directions n of the normal. So, in the mean over places and directions of the
/// surface, the flows on both sides do not slip past each other under a force along it, and the velocity of
/// its nodes does not go by the shear stress (docs/kernels.md, "Two fluids"). It is 0 for equal viscosities.
/// Of viscosities so different that tangential_shortfall() would turn negative, it is the length that makes
/// that 0.
/// @throws std::invalid_argument unless both viscosities are positive and finite, or if the kernel has no
/// slopes
double dipole_length(const Kernel& kernel, const SideViscosities& viscosities);

/// The velocity along the surface that a node gets less than the sharp surface has, for a force 1 an area
/// along it: of a plane sheet along the grid, in the mean over its places. For equal viscosities it is
/// tangential_shortfall(kernel)/mu, without a dipole tangential_shortfall(kernel) (1/mu_o + 1/mu_i)/2.
/// @param dipole_length of the surface's ShearDipole; 0: it has none
/// @throws std::invalid_argument as dipole_length()
double tangential_shortfall(const Kernel& kernel, const SideViscosities& viscosities, double dipole_length);

}  // namespace tanktread::coupler
