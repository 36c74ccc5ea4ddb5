// What the rank that owns a capsule and the ranks near it tell each other.
#pragma once

#include <span>
#include <vector>

#include "driver/packets/packets.hpp"
#include "driver/system/part_places.hpp"
#include "ranks/division.hpp"
#include "ranks/world.hpp"

namespace tanktread::driver {

/// The capsules of which a rank computes the membranes.
struct OwnCapsules {
  std::vector<std::size_t> numbers;         ///< in the case, ascending
  std::vector<Eigen::Matrix3Xi> triangles;  ///< of each
  NodeVectors positions, velocity, force;   ///< of each
};

/// The capsules whose nodes may touch a rank's block: a place for each of the case, without nodes where it is
/// not near.
struct NearCapsules {
  Surfaces surfaces;
  NodeVectors velocity;  ///< of the nodes at home in the block; the others' is of no use
  NodeVectors force;
};

/// All ranks call its functions together.
class CapsuleMessages {
 public:
  /// World is borrowed. @param reach grid steps from a node at which it is near
  CapsuleMessages(const ranks::World& world, const ranks::Division& division, int reach);

  /// Forgets whom it has told of triangles, and what it was told: capsules have other owners from now on.
  void forget();

  /// Positions and forces of all capsules to the ranks that they are near to now.
  /// @param near a place for each capsule of the case
  void send_surfaces(const OwnCapsules& own, NearCapsules& near);

  /// Forces alone, to the same ranks.
  void send_forces(const NodeVectors& own, NodeVectors& near) const;

  /// The velocity of every node from the rank where it is at home to the owner of its capsule.
  /// @param home nodes of each capsule of the case that are at home here
  /// @throws std::logic_error if a node is at home nowhere
  void bring_velocities(const NodeVectors& near, std::span<const std::span<const std::int32_t>> home,
                        NodeVectors& own) const;

 private:
  std::vector<int> ranks_near(const Eigen::Matrix3Xd& positions) const;
  std::vector<int> parts_near(int axis, double lowest, double highest) const;

  const ranks::World& world_;
  PartPlaces places_;
  int reach_;
  std::vector<std::vector<int>> near_ranks_;      ///< of each own capsule, ascending
  std::vector<std::vector<int>> know_triangles_;  ///< ranks that have those of each own capsule
  std::vector<int> partners_;                     ///< ranks near to any own capsule, ascending
  struct Origin {
    int owner;                         ///< a rank
    std::vector<std::size_t> numbers;  ///< of its capsules that are near here, in its order
  };
  std::vector<Origin> origins_;              ///< ascending by owner
  std::vector<int> owners_;                  ///< of these
  std::vector<Eigen::Matrix3Xi> triangles_;  ///< of every capsule that has been near
  std::vector<std::size_t> own_numbers_;
};

}  // namespace tanktread::driver
