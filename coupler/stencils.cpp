#include "coupler/stencils.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace tanktread::coupler {
namespace {

/// Nodes whose weights are computed in one go.
constexpr std::size_t weighed_at_once = 64;

/// Index of the k-th grid node of a stencil along an axis.
int index_of(int first, int k, int nodes) {
  const int index = first + k;
  return index < nodes ? index : index - nodes;
}

/// Calls visit(share) once for each share of the grid that has planes of a stencil.
template <class Visit>
void visit_shares(const std::vector<int>& share_of_plane, int first_plane, int width, const Visit& visit) {
  const int n_planes = static_cast<int>(share_of_plane.size()), start = share_of_plane[first_plane];
  visit(start);
  // Shares follow one another; behind the periodic face comes the first again, at last perhaps that of the
  // start.
  for (int k = 1, last = start; k < width; ++k) {
    const int share = share_of_plane[index_of(first_plane, k, n_planes)];
    if (share != last && share != start) visit(share);
    last = share;
  }
}

}  // namespace

StencilBuilder::StencilBuilder(const Grid& grid, const GridPart& part, const Kernel& kernel, int n_shares)
    : grid_(grid),
      kernel_(kernel),
      width_(width_of(kernel)),
      n_shares_(n_shares),
      region_(region_of(grid, part, width_)),
      region_grid_(grid_of_region(grid, region_)),
      selector_(grid, part, kernel, n_shares),
      axes_{AxisStencil(grid, region_, 0, kernel_), AxisStencil(grid, region_, 1, kernel_),
            AxisStencil(grid, region_, 2, kernel_)},
      marks_(region_grid_),
      share_of_plane_(region_grid_.nodes[2]),
      counts_(n_shares,
              Counts{std::vector<std::size_t>(region_grid_.nodes[2]), std::vector<std::size_t>(n_shares)}) {}

void StencilBuilder::build(std::span<const std::span<const double>> surfaces,
                           std::span<const ShearDipole> dipoles, Stencils& stencils) {
  select(surfaces, stencils);
  check_dipoles(dipoles, stencils);
  take_dipoles(dipoles, stencils);
  weigh(surfaces, stencils);
  cut_grid(stencils);
  list_share_nodes(stencils);
  mark(stencils);
  number(stencils);
}

// Which membrane nodes have stencils, and the memory for these.
void StencilBuilder::select(std::span<const std::span<const double>> surfaces, Stencils& stencils) {
  stencils.width = width_;
  for (std::size_t s = 0; s < surfaces.size(); ++s) {
    if (surfaces[s].size() % 3 == 0) continue;
    throw std::invalid_argument("coupler: surface " + std::to_string(s) + " has " +
                                std::to_string(surfaces[s].size()) +
                                " coordinates; 3 numbers a node are needed");
  }
  selector_.select(surfaces, stencils.nodes);
  const std::size_t n = stencils.n_nodes();
  stencils.weights.resize(3 * n * width_);
  stencils.first.resize(n);
  stencils.run.resize(n * width_ * width_);
  stencils.across.resize(n);
}

// Weights and lowest grid indices; refuses the first node (by its number) that has no stencil.
void StencilBuilder::weigh(std::span<const std::span<const double>> surfaces, Stencils& stencils) {
  const std::size_t n = stencils.n_nodes();
#pragma omp parallel for num_threads(n_shares_) schedule(static, 1)
  for (int share = 0; share < n_shares_; ++share) {
    Counts& counts = counts_[share];
    std::ranges::fill(counts.of_first_plane, 0);
    counts.across = 0;
    counts.first_refused = n;
    const NodeRange range(n, share, n_shares_);
    SurfaceOfNode surface(stencils.nodes);
    for (std::size_t begin = range.begin, end; begin < range.end; begin = end) {
      const std::size_t s = surface.of(begin);
      end = std::min({range.end, stencils.nodes.first_stencil[s + 1], begin + weighed_at_once});
      double memory[3 * weighed_at_once];
      weigh_nodes(stencils.nodes.positions_of(surfaces[s].data(), surface.node(begin), begin, end, memory),
                  begin, end, stencils.dipole_length(s) != 0, stencils, counts);
      if (counts.first_refused < n) break;
    }
  }
  for (const Counts& counts : counts_) {
    if (counts.first_refused == n) continue;
    SurfaceOfNode surface(stencils.nodes);
    const std::size_t s = surface.of(counts.first_refused), node = surface.node(counts.first_refused);
    refuse(s, node, &surfaces[s][3 * node]);
  }
}

// @param positions of the stencil `begin` and on
void StencilBuilder::weigh_nodes(const double* positions, std::size_t begin, std::size_t end,
                                 bool with_slopes, Stencils& stencils, Counts& counts) const {
  const int n_coordinates = static_cast<int>(3 * (end - begin));
  double lowest[3 * weighed_at_once], distances[3 * weighed_at_once];
  for (int k = 0; k < n_coordinates; ++k) {
    const auto found = axes_[0].lowest(positions[k]);  // of any axis
    lowest[k] = found.node;
    distances[k] = found.distance;
  }
  double* weights = &stencils.weights[3 * begin * width_];
  weights_of(kernel_, n_coordinates, distances, weights);
  double* slopes = with_slopes ? &stencils.slopes[3 * begin * width_] : nullptr;
  if (with_slopes) slopes_of(kernel_, n_coordinates, distances, slopes);
  for (std::size_t m = begin; m < end; ++m) {
    auto& first = stencils.first[m];
    for (int axis = 0; axis < 3; ++axis) {
      const std::size_t k = 3 * (m - begin) + axis;
      if (axes_[axis].fit(positions[k], lowest[k], first[axis], weights + k * width_,
                          with_slopes ? slopes + k * width_ : nullptr) == Fit::inside)
        continue;
      counts.first_refused = m;
      return;
    }
    ++counts.of_first_plane[first[2]];
    counts.across += first[0] + width_ > region_grid_.nodes[0];
  }
}

// Neighbouring planes to one share, about as many planes of stencils to each.
void StencilBuilder::cut_grid(Stencils& stencils) {
  const int nz = region_grid_.nodes[2];
  std::vector<std::size_t> before(nz + 1, 0);  // planes of stencils in the planes before each
  for (const Counts& counts : counts_) {
    for (int z = 0; z < nz; ++z) {
      for (int k = 0; k < width_; ++k) before[index_of(z, k, nz) + 1] += counts.of_first_plane[z];
    }
  }
  for (int z = 0; z < nz; ++z) before[z + 1] += before[z];
  stencils.shares.assign(n_shares_, {});
  for (int share = 0, z = 0; share < n_shares_; ++share) {
    stencils.shares[share].first_plane = z;
    // As far as the middle of the plane that goes beyond the aim.
    const double aim = static_cast<double>(before[nz]) * (share + 1) / n_shares_;
    for (; z < nz && (share + 1 == n_shares_ || 0.5 * static_cast<double>(before[z] + before[z + 1]) < aim);
         ++z)
      share_of_plane_[z] = share;
    stencils.shares[share].last_plane = z;
  }
}

// In ascending order: every grid node shall receive its parts in the order of the membrane nodes.
void StencilBuilder::list_share_nodes(Stencils& stencils) {
  const std::size_t n = stencils.n_nodes();
#pragma omp parallel for num_threads(n_shares_) schedule(static, 1)
  for (int part = 0; part < n_shares_; ++part) {
    std::vector<std::size_t>& of_share = counts_[part].of_share;
    std::ranges::fill(of_share, 0);
    const NodeRange range(n, part, n_shares_);
    for (std::size_t m = range.begin; m < range.end; ++m)
      visit_shares(share_of_plane_, stencils.first[m][2], width_, [&](int share) { ++of_share[share]; });
  }
  std::size_t listed = 0;
  for (int share = 0; share < n_shares_; ++share) {
    stencils.shares[share].first_node = listed;
    // From now on where the nodes of each part begin in the list.
    for (Counts& counts : counts_) listed += std::exchange(counts.of_share[share], listed);
    stencils.shares[share].last_node = listed;
  }
  stencils.share_nodes.resize(listed);
#pragma omp parallel for num_threads(n_shares_) schedule(static, 1)
  for (int part = 0; part < n_shares_; ++part) {
    std::vector<std::size_t>& next = counts_[part].of_share;
    const NodeRange range(n, part, n_shares_);
    for (std::size_t m = range.begin; m < range.end; ++m) {
      visit_shares(share_of_plane_, stencils.first[m][2], width_,
                   [&](int share) { stencils.share_nodes[next[share]++] = m; });
    }
  }
}

GridMarks::Rows StencilBuilder::rows_of(const GridShare& share) const {
  const std::int64_t ny = region_grid_.nodes[1];
  return {share.first_plane * ny, share.last_plane * ny};
}

// Marks the grid nodes of the stencils, and counts them.
void StencilBuilder::mark(Stencils& stencils) {
#pragma omp parallel for num_threads(n_shares_) schedule(static, 1)
  for (int k = 0; k < n_shares_; ++k) {
    GridShare& share = stencils.shares[k];
    marks_.clear(rows_of(share));
    for_width(width_, [&]<int width>() { mark_share<width>(stencils, share); });
    share.last_number = marks_.count(rows_of(share));
  }
  std::int64_t count = 0;
  for (GridShare& share : stencils.shares) {
    share.first_number = count;
    share.last_number = count += share.last_number;
  }
  if (count > std::numeric_limits<std::int32_t>::max())
    throw std::length_error("coupler: the stencils touch more than 2^31 - 1 grid nodes");
  if (stencils.grid_nodes.use_count() > 1)
    stencils.grid_nodes = std::make_shared<std::vector<std::int64_t>>();
  stencils.grid_nodes->resize(count);
}

template <int width>
void StencilBuilder::mark_share(const Stencils& stencils, const GridShare& share) {
  const int nx = region_grid_.nodes[0], nz = region_grid_.nodes[2];
  for (std::size_t k = share.first_node; k < share.last_node; ++k) {
    const auto& first = stencils.first[stencils.share_nodes[k]];
    const int before_face = std::min(width, nx - first[0]);
    const GridMarks::Run run(first[0], before_face);
    for (int kz = 0; kz < width; ++kz) {
      const int z = index_of(first[2], kz, nz);
      if (!share.has_plane(z)) continue;
      marks_.mark<width>(z, first[1], run);
      if (before_face < width) marks_.mark<width>(z, first[1], GridMarks::Run(0, width - before_face));
    }
  }
}

// Numbers the grid nodes, and finds the numbers in the rows of all stencils.
void StencilBuilder::number(Stencils& stencils) {
#pragma omp parallel for num_threads(n_shares_) schedule(static, 1)
  for (int k = 0; k < n_shares_; ++k) {
    const GridShare& share = stencils.shares[k];
    marks_.number(rows_of(share), share.first_number, stencils.grid_nodes->data() + share.first_number);
  }
  std::int32_t across = 0;
  for (Counts& counts : counts_) across += std::exchange(counts.across, across);  // those before from now on
  stencils.across_run.resize(std::size_t{1} * across * width_ * width_);
#pragma omp parallel for num_threads(n_shares_) schedule(static, 1)
  for (int part = 0; part < n_shares_; ++part)
    for_width(width_, [&]<int width>() { find_runs<width>(part, stencils); });
}

template <int width>
void StencilBuilder::find_runs(int part, Stencils& stencils) const {
  const NodeRange range(stencils.n_nodes(), part, n_shares_);
  const int nx = region_grid_.nodes[0], nz = region_grid_.nodes[2];
  std::int32_t next_across = counts_[part].across;
  for (std::size_t m = range.begin; m < range.end; ++m) {
    const auto& first = stencils.first[m];
    const auto list_numbers = [&](int x, std::int32_t* numbers) {
      const GridMarks::Place place(x);
      for (int kz = 0; kz < width; ++kz)
        marks_.numbers_of<width>(index_of(first[2], kz, nz), first[1], place, numbers + kz * width);
    };
    list_numbers(first[0], &stencils.run[m * width * width]);
    stencils.across[m] = first[0] + width > nx ? next_across++ : -1;
    if (stencils.across[m] < 0) continue;
    list_numbers(0, &stencils.across_run[std::size_t{1} * stencils.across[m] * width * width]);
  }
}

}  // namespace tanktread::coupler
