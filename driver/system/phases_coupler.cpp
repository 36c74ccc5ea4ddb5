#include "coupler/volume.hpp"
#include "driver/system/node_ranges.hpp"
#include "driver/system/node_spans.hpp"
#include "driver/system/phases.hpp"

namespace tanktread::driver {
namespace {

void keep_volume(const Surfaces& surfaces, const std::vector<std::span<double>>& velocity) {
  const auto positions = views(surfaces.positions);
  for (std::size_t k = 0; k < velocity.size(); ++k) {
    coupler::keep_volume(positions[k], numbers_of(surfaces.triangles[k]), velocity[k]);
  }
}

}  // namespace

void build_stencils(coupler::Coupler& coupler, const NodeCorrections& corrections,
                    const NodeVectors& positions, const std::vector<Eigen::Matrix3Xi>& triangles) {
  std::vector<coupler::ShearDipole> dipoles;
  if (!corrections.dipole_lengths.empty()) {
    const auto normals = corrections.normals->find(views(positions), corners_of(triangles));
    for (std::size_t k = 0; k < normals.size(); ++k)
      dipoles.push_back({normals[k], corrections.dipole_lengths[k]});
  }
  coupler.build(views(positions), dipoles);
}

NodeVectors velocity_of_nodes(const coupler::Coupler& coupler, const NodeCorrections& corrections,
                              const GridVectors& velocity, const Surfaces& surfaces,
                              const NodeVectors& force) {
  auto result = interpolated_velocity(coupler, velocity, surfaces.positions);
  correct_velocity(coupler, corrections, surfaces, force, result);
  return result;
}

NodeVectors interpolated_velocity(const coupler::Coupler& coupler, const GridVectors& velocity,
                                  const NodeVectors& positions, NodeVectors memory) {
  resize_like(positions, memory);
  const auto targets = targets_of(memory);
  const auto nodes = coupler.grid_node_list();
  if (are_on(velocity, nodes)) {
    coupler.interpolate(velocity.values, targets);
  } else {
    coupler.interpolate(on_nodes(velocity, nodes, "velocity").values, targets);
  }
  return memory;
}

void correct_velocity(const coupler::Coupler& coupler, const NodeCorrections& corrections,
                      const Surfaces& surfaces, const NodeVectors& force, NodeVectors& velocity) {
  const auto targets = targets_of(velocity);
  if (corrections.along_membrane) {
    const auto normals = corrections.normals->find(views(surfaces.positions), corners_of(surfaces.triangles));
    corrections.along_membrane->add(coupler, normals, views(force), targets);
  }
  if (corrections.keeps_volume) keep_volume(surfaces, targets);
}

GridVectors spread(coupler::Coupler& coupler, const NodeCorrections& corrections,
                   const NodeVectors& positions, const std::vector<Eigen::Matrix3Xi>& triangles,
                   const NodeVectors& force) {
  build_stencils(coupler, corrections, positions, triangles);
  return spread_force(coupler, force);
}

GridVectors spread_force(const coupler::Coupler& coupler, const NodeVectors& force, GridVectors memory) {
  memory.nodes = coupler.grid_node_list();
  memory.values.resize(3 * memory.nodes->size());
  coupler.spread(views(force), memory.values);
  return memory;
}

}  // namespace tanktread::driver
