#include "fluid/population_lattice.hpp"

#include <sys/mman.h>

#include <cstddef>

#include "fluid/pack.hpp"

namespace tanktread::fluid {
namespace {

/// Walking 19 planes side by side needs 19 entries of the processor's page table at once, and new ones every
/// 4096 bytes: with pages of 2 MiB a step takes a tenth less. A system that has none goes on without.
void ask_for_huge_pages([[maybe_unused]] void* memory, [[maybe_unused]] std::size_t n_bytes) {
#ifdef MADV_HUGEPAGE
  ::madvise(memory, n_bytes, MADV_HUGEPAGE);
#endif
}

}  // namespace

LatticeLayout layout_of(const PartBorder& border, int bytes_of_number) {
  const std::int64_t line = cache_line_bytes / bytes_of_number;  // numbers of a cache line, some packs
  const auto& n = border.n();
  LatticeLayout layout;
  // A halo along x has a line at each end, so that rows begin at a line. The last pack may reach into it.
  layout.lead = border.halo(0) * line;
  layout.row_stride = layout.lead + (n[0] + line - 1) / line * line + layout.lead;
  layout.rows_a_layer = n[1] + 2 * border.halo(1);
  // The 19 planes are walked side by side. Were they a multiple of 4096 bytes apart, all would fall in the
  // same few sets of the first-level cache; were they little more than a power of two apart, in the same few
  // banks of the memory (at 128^3 a fifth slower). 91 lines more than a multiple of 16 KiB keep them apart in
  // both.
  std::int64_t lines = layout.rows_a_layer * (n[2] + 2 * border.halo(2)) * layout.row_stride / line;
  lines += (91 - lines % 256 + 256) % 256;
  layout.plane_stride = lines * line;
  return layout;
}

template <typename Real>
PopulationLattice<Real>::PopulationLattice(const GridShape& box, const std::optional<WallPair>& walls,
                                           const GridPart& part)
    : walls_(walls), shape_(part.shape), border_(box, walls, part) {
  allocate();
  if (walls_) set_wall_gains();
}

template <typename Real>
void PopulationLattice<Real>::allocate() {
  const auto layout = layout_of(border_, sizeof(Real));
  rows_a_layer_ = layout.rows_a_layer;
  row_stride_ = layout.row_stride;
  plane_stride_ = layout.plane_stride;
  const std::size_t n_bytes = sizeof(Real) * layout.n_numbers();
  planes_.reset(static_cast<Real*>(::operator new[](n_bytes, huge_page)));
  ask_for_huge_pages(planes_.get(), n_bytes);
  first_row_ =
      planes_.get() + (border_.halo(2) * rows_a_layer_ + border_.halo(1)) * row_stride_ + layout.lead;
}

template <typename Real>
void PopulationLattice<Real>::set_wall_gains() {
  for (int i = 0; i < d3q19::n_directions; ++i) {
    const auto& c = d3q19::velocity[i];
    if (c[walls_->axis] == 0) continue;
    // A population that comes in with c > 0 along the wall axis was sent back by the low wall.
    const auto& wall = c[walls_->axis] > 0 ? walls_->low_velocity : walls_->high_velocity;
    wall_gain_[i] = static_cast<Real>(2.0 * d3q19::weight(i) * d3q19::inverse_sound_speed_squared *
                                      (c[0] * wall[0] + c[1] * wall[1] + c[2] * wall[2]));
  }
}

template <typename Real>
bool PopulationLattice<Real>::from_wall(int direction, int x, int y, int z) const {
  if (!walls_) return false;
  const int axis = walls_->axis, position = axis == 0 ? x : (axis == 1 ? y : z);
  const int source = border_.begin()[axis] + position - d3q19::velocity[direction][axis];
  return source < 0 || source >= border_.box()[axis];
}

template <typename Real>
int PopulationLattice<Real>::in_memory(int position, int axis) const {
  if (is_cut(axis)) return position;
  const int n = border_.box()[axis];
  return position < 0 ? position + n : (position >= n ? position - n : position);
}

template <typename Real>
Real* PopulationLattice<Real>::row_slot(Turn turn, int direction, int y, int z) const {
  // x = 1 stands for any x away from the ends of the row: only walls across y and z matter here.
  if (turn == Turn::local || from_wall(direction, 1, y, z)) return row(direction, y, z);
  const auto& c = d3q19::velocity[direction];
  return row(d3q19::opposite(direction), in_memory(y - c[1], 1), in_memory(z - c[2], 2)) - c[0];
}

template <typename Real>
Real* PopulationLattice<Real>::slot(Turn turn, int direction, int x, int y, int z) const {
  if (turn == Turn::local || from_wall(direction, x, y, z)) return row(direction, y, z) + x;
  const auto& c = d3q19::velocity[direction];
  return row(d3q19::opposite(direction), in_memory(y - c[1], 1), in_memory(z - c[2], 2)) +
         in_memory(x - c[0], 0);
}

template <typename Real>
void PopulationLattice<Real>::get_outgoing(Turn last, int x, int y, int z, Real* populations) const {
  for (int i = 0; i < d3q19::n_directions; ++i) populations[i] = *slot(last, d3q19::opposite(i), x, y, z);
}

template <typename Real>
void PopulationLattice<Real>::put_outgoing(Turn last, int x, int y, int z, const Real* populations) {
  for (int i = 0; i < d3q19::n_directions; ++i) *slot(last, d3q19::opposite(i), x, y, z) = populations[i];
}

template class PopulationLattice<double>;
template class PopulationLattice<float>;

}  // namespace tanktread::fluid
