// What is behind a Coupler: its stencils, and the loops that take vectors from the grid to the membrane nodes
// and back. Internal to the coupler.
#pragma once

#include <algorithm>
#include <span>
#include <stdexcept>
#include <string>

#include "coupler/coupler.hpp"
#include "coupler/dipole_stencil.hpp"
#include "coupler/node_stencil.hpp"
#include "coupler/stencils.hpp"

namespace tanktread::coupler {

/// @throws std::invalid_argument unless an array has as many numbers as it must
inline void check_size(const std::string& what, std::size_t size, std::size_t needed) {
  if (size == needed) return;
  throw std::invalid_argument("coupler: " + what + ": " + std::to_string(size) + " given, " +
                              std::to_string(needed) + " needed");
}

/// What of the stencils a transfer goes by.
enum class With { weights_alone, dipoles };

struct Coupler::Implementation {
  Implementation(const Grid& the_grid, const GridPart& part, const Kernel& kernel, int shares)
      : n_shares(shares), builder(the_grid, part, kernel, shares), grid(builder.grid_of_stencils()) {}

  /// @throws std::invalid_argument unless `surfaces` are as many, and as long, as those that the stencils
  /// were built for
  template <class Surfaces>
  void check_surfaces(const std::string& what, const Surfaces& surfaces) const {
    check_size(what + ", surfaces", surfaces.size(), stencils.n_surfaces());
    for (std::size_t s = 0; s < surfaces.size(); ++s) {
      const std::size_t needed = 3 * stencils.nodes.n_nodes_of_surface[s];
      if (surfaces[s].size() != needed)
        check_size(what + ", numbers of surface " + std::to_string(s), surfaces[s].size(), needed);
    }
  }

  /// Whether holds(surface, node) for every membrane node that has a stencil.
  template <class Holds>
  bool for_all_nodes(const Holds& holds) const {
    bool all = true;
#pragma omp parallel for num_threads(n_shares) schedule(static, 1) reduction(&& : all)
    for (int share = 0; share < n_shares; ++share) {
      const NodeRange range(stencils.n_nodes(), share, n_shares);
      SurfaceOfNode surface(stencils.nodes);
      for (std::size_t m = range.begin; m < range.end; ++m) {
        const std::size_t s = surface.of(m);
        all = all && holds(s, surface.node(m));
      }
    }
    return all;
  }

  /// Calls take(surface, node, u_m) for every membrane node at home, from any thread.
  template <class Take>
  void interpolate(With with, std::span<const double> grid_velocity, const Take& take) const {
    if (stencils.n_nodes() == 0) return;
    for_width(stencils.width, [&]<int width>() {
#pragma omp parallel for num_threads(n_shares) schedule(static, 1)
      for (int share = 0; share < n_shares; ++share)
        interpolate_share<width>(with, share, grid_velocity.data(), take);
    });
  }

  /// Overwrites grid_force. @param force force(surface, node, F_m) writes the three numbers; it is called
  /// more than once for some nodes, from any thread
  template <class Force>
  void spread(With with, const Force& force, std::span<double> grid_force) const {
    if (stencils.n_nodes() == 0) return;
    for_width(stencils.width, [&]<int width>() {
#pragma omp parallel for num_threads(n_shares) schedule(static, 1)
      for (int share = 0; share < n_shares; ++share)
        spread_share<width>(with, stencils.shares[share], force, grid_force.data());
    });
  }

  int n_shares;
  StencilBuilder builder;
  Grid grid;          ///< whose nodes the stencils name
  Stencils stencils;  ///< in use
  Stencils next;      ///< being built, so that the old ones stay if that fails

 private:
  bool has_dipole(With with, std::size_t surface) const {
    return with == With::dipoles && stencils.dipole_length(surface) != 0;
  }

  template <int width, class Take>
  void interpolate_share(With with, int share, const double* grid_velocity, const Take& take) const {
    const NodeRange range(stencils.nodes.n_home(), share, n_shares);
    SurfaceOfNode surface(stencils.nodes);
    for (std::size_t k = range.begin; k < range.end; ++k) {
      const std::size_t m = stencils.nodes.home_stencil(k);
      double velocity[3];
      const std::size_t s = surface.of(m);
      if (has_dipole(with, s)) {
        DipoleStencil<width>(stencils, m, s, grid.nodes[0]).take(grid_velocity, velocity);
      } else {
        NodeStencil<width>(stencils, m, grid.nodes[0]).take(grid_velocity, velocity);
      }
      take(s, surface.node(m), velocity);
    }
  }

  // The share alone writes to its planes, and goes through their membrane nodes in order: every grid node
  // receives its parts in the order of the membrane nodes, however many shares there are.
  template <int width, class Force>
  void spread_share(With with, const GridShare& share, const Force& force, double* grid_force) const {
    std::fill(grid_force + 3 * share.first_number, grid_force + 3 * share.last_number, 0.0);
    SurfaceOfNode surface(stencils.nodes);
    for (std::size_t k = share.first_node; k < share.last_node; ++k) {
      const std::size_t m = stencils.share_nodes[k], s = surface.of(m);
      double node_force[3];
      force(s, surface.node(m), node_force);
      const auto has_plane = [&](int z) { return share.has_plane(z); };
      if (has_dipole(with, s)) {
        DipoleStencil<width>(stencils, m, s, grid.nodes[0])
            .give(node_force, stencils.first[m][2], grid.nodes[2], has_plane, grid_force);
      } else {
        NodeStencil<width>(stencils, m, grid.nodes[0])
            .give(node_force, stencils.first[m][2], grid.nodes[2], has_plane, grid_force);
      }
    }
  }
};

}  // namespace tanktread::coupler
