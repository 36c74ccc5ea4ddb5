// The rows of a part, told apart by what a step of them needs. Internal to fluid/.
#pragma once

#include <cstdint>
#include <vector>

#include "fluid/population_lattice.hpp"

namespace tanktread::fluid {

/// Numbers of rows, z ny + y. All rows of a whole box are inner ones.
struct PartRows {
  std::vector<std::int64_t> inner;    ///< a step can advance them before what comes from other parts is there
  std::vector<std::int64_t> at_cuts;  ///< these wait
};

template <typename Real>
PartRows rows_of(const PopulationLattice<Real>& lattice) {
  const int ny = lattice.shape().ny, nz = lattice.shape().nz;
  const auto at_cut = [&](int axis, int position, int n) {
    return lattice.is_cut(axis) && (position == 0 || position == n - 1);
  };
  PartRows rows;
  for (int z = 0; z < nz; ++z) {
    for (int y = 0; y < ny; ++y) {
      const bool waits = lattice.is_cut(0) || at_cut(1, y, ny) || at_cut(2, z, nz);
      (waits ? rows.at_cuts : rows.inner).push_back(std::int64_t{z} * ny + y);
    }
  }
  return rows;
}

}  // namespace tanktread::fluid
