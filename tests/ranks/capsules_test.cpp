// What ranks tell each other of grid nodes and capsules, on any number of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "driver/system/capsule_messages.hpp"
#include "driver/system/region_halo.hpp"
#include "tests/ranks/world.hpp"

namespace tanktread::driver::test {
namespace {

using ranks::test::all_ranks;

constexpr std::array<int, 3> box = {16, 14, 18};
constexpr int reach = 3;

/// Every way to cut the box among the ranks.
std::vector<ranks::Division> divisions(const std::array<bool, 3>& periodic) {
  std::vector<ranks::Division> found;
  const int n = all_ranks->size();
  for (int x = 1; x <= n; ++x)
    for (int y = 1; x * y <= n; ++y)
      if (n % (x * y) == 0) found.push_back({{box, periodic, {1, 1, 1}}, {x, y, n / (x * y)}});
  return found;
}

/// The block of this rank with some layers around it, as long as no node is in it twice.
coupler::GridPart region_of(const ranks::Division& division) {
  const auto block = division.block(all_ranks->rank());
  coupler::GridPart region{block.begin, block.n};
  for (int axis = 0; axis < 3; ++axis) {
    int begin = block.begin[axis] - reach, end = block.begin[axis] + block.n[axis] + reach;
    if (!division.box().periodic[axis]) begin = std::max(begin, 0), end = std::min(end, box[axis]);
    if (end - begin >= box[axis]) begin = 0, end = box[axis];
    region.begin[axis] = begin;
    region.nodes[axis] = end - begin;
  }
  return region;
}

/// A number for each node of the box that no other has.
double number_of(const std::array<int, 3>& node, int component) {
  return ((node[2] * 100.0 + node[1]) * 100.0 + node[0]) * 10.0 + component;
}

int wrapped(int node, int n) {
  return (node % n + n) % n;
}

TEST(RegionHalo, brings_the_numbers_of_other_ranks_nodes) {
  for (const std::array<bool, 3> periodic :
       {std::array{true, true, true}, std::array{true, true, false}, std::array{false, true, true}}) {
    for (const auto& division : divisions(periodic)) {
      const auto region = region_of(division);
      const auto block = division.block(all_ranks->rank());
      RegionHalo halo(*all_ranks, division, region);
      // All nodes, then every fifth of the box, then none.
      for (const int stride : {1, 5, 1 << 20}) {
        std::vector<std::int64_t> nodes;
        std::vector<std::array<int, 3>> in_box;
        for (int z = 0; z < region.nodes[2]; ++z) {
          for (int y = 0; y < region.nodes[1]; ++y) {
            for (int x = 0; x < region.nodes[0]; ++x) {
              const std::array<int, 3> node = {wrapped(region.begin[0] + x, box[0]),
                                               wrapped(region.begin[1] + y, box[1]),
                                               wrapped(region.begin[2] + z, box[2])};
              if (stride > 100 || (node[0] + 3 * node[1] + 7 * node[2]) % stride != 0) continue;
              nodes.push_back((std::int64_t{z} * region.nodes[1] + y) * region.nodes[0] + x);
              in_box.push_back(node);
            }
          }
        }
        halo.find(nodes);
        std::vector<double> own, of_list(3 * nodes.size(), -1);
        for (const std::int64_t node : halo.own_nodes()) {
          const std::array<int, 3> at = {block.begin[0] + static_cast<int>(node % block.n[0]),
                                         block.begin[1] + static_cast<int>(node / block.n[0] % block.n[1]),
                                         block.begin[2] + static_cast<int>(node / block.n[0] / block.n[1])};
          for (int component = 0; component < 3; ++component) own.push_back(number_of(at, component));
        }
        halo.place_own(own, 3, of_list);
        halo.complete(3, of_list);
        for (std::size_t k = 0; k < nodes.size(); ++k)
          for (std::size_t component = 0; component < 3; ++component)
            ASSERT_EQ(of_list[3 * k + component], number_of(in_box[k], static_cast<int>(component)));
        std::vector<double> taken;
        halo.take_own(of_list, 3, taken);
        EXPECT_EQ(taken, own);
      }
    }
  }
}

/// A cloud of nodes around a centre, which may lie anywhere.
Eigen::Matrix3Xd cloud(const Eigen::Vector3d& centre) {
  Eigen::Matrix3Xd nodes(3, 27);
  for (int k = 0; k < 27; ++k)
    nodes.col(k) = centre + 1.5 * Eigen::Vector3d(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1);
  return nodes;
}

/// Whether a node may touch a grid node of the block, or be in one of its cells.
bool is_near(const Eigen::Vector3d& node, const ranks::Division& division, int rank) {
  const auto block = division.block(rank);
  for (int axis = 0; axis < 3; ++axis) {
    bool is_in = false;
    for (int away = -(reach - 1); away <= reach - 1; ++away) {
      int cell = static_cast<int>(std::floor(node[axis])) + away;
      if (division.box().periodic[axis]) cell = wrapped(cell, box[axis]);
      is_in |= cell >= block.begin[axis] && cell < block.begin[axis] + block.n[axis];
    }
    if (!is_in) return false;
  }
  return true;
}

int home_of(const Eigen::Vector3d& node, const ranks::Division& division) {
  ranks::Triple cell;
  for (int axis = 0; axis < 3; ++axis)
    cell[axis] = wrapped(static_cast<int>(std::floor(node[axis])), box[axis]);
  return division.owner(cell);
}

TEST(CapsuleMessages, tell_the_ranks_near_a_capsule_and_bring_back_the_velocity_of_its_nodes) {
  const int size = all_ranks->size(), rank = all_ranks->rank();
  const std::vector<Eigen::Vector3d> centres = {{8, 7, 9}, {0.2, 13.9, 17.8}, {-35, 40, 3}, {8, 7, 2}};
  for (const auto& division : divisions({true, true, true})) {
    CapsuleMessages messages(*all_ranks, division, reach);
    OwnCapsules own;
    for (std::size_t k = 0; k < centres.size(); ++k) {
      if (static_cast<int>(k) % size != rank) continue;
      own.numbers.push_back(k);
      own.triangles.push_back(Eigen::Matrix3Xi::Constant(3, 5, static_cast<int>(k)));
      own.positions.push_back(cloud(centres[k]));
      own.velocity.push_back(Eigen::Matrix3Xd::Zero(3, 27));
      own.force.push_back(Eigen::Matrix3Xd::Constant(3, 27, static_cast<double>(k)));
    }
    const NodeVectors none(centres.size(), Eigen::Matrix3Xd(3, 0));
    NearCapsules near{
        {none, std::vector<Eigen::Matrix3Xi>(centres.size(), Eigen::Matrix3Xi(3, 0))}, none, none};
    for (int step = 0; step < 4; ++step) {  // on the way some come near, and some go
      messages.send_surfaces(own, near);
      for (auto& force : own.force) force.array() += 0.5;
      messages.send_forces(own.force, near.force);
      std::vector<std::vector<std::int32_t>> home(centres.size());
      for (std::size_t k = 0; k < centres.size(); ++k) {
        const auto positions = cloud(centres[k] + 2.0 * step * Eigen::Vector3d(1, 1, -1));
        bool must_be_near = false;
        for (int node = 0; node < positions.cols(); ++node)
          must_be_near |= is_near(positions.col(node), division, rank);
        if (near.surfaces.positions[k].cols() == 0) {
          ASSERT_FALSE(must_be_near) << "capsule " << k;
          EXPECT_EQ(near.force[k].cols() + near.surfaces.triangles[k].cols(), 0);
          continue;
        }
        EXPECT_EQ(near.surfaces.positions[k], positions);
        EXPECT_EQ(near.surfaces.triangles[k], Eigen::Matrix3Xi::Constant(3, 5, static_cast<int>(k)));
        EXPECT_EQ(near.force[k],
                  Eigen::Matrix3Xd::Constant(3, 27, static_cast<double>(k) + 0.5 * (step + 1)));
        near.velocity[k].setConstant(-1);
        for (int node = 0; node < positions.cols(); ++node) {
          if (home_of(positions.col(node), division) != rank) continue;
          home[k].push_back(node);
          near.velocity[k].col(node) = Eigen::Vector3d(static_cast<double>(k), node, step);
        }
      }
      const std::vector<std::span<const std::int32_t>> home_spans(home.begin(), home.end());
      messages.bring_velocities(near.velocity, home_spans, own.velocity);
      for (std::size_t j = 0; j < own.numbers.size(); ++j) {
        for (int node = 0; node < 27; ++node)
          EXPECT_EQ(own.velocity[j].col(node),
                    Eigen::Vector3d(static_cast<double>(own.numbers[j]), node, step));
        own.positions[j] = cloud(centres[own.numbers[j]] + 2.0 * (step + 1) * Eigen::Vector3d(1, 1, -1));
      }
    }
  }
}

}  // namespace
}  // namespace tanktread::driver::test
