// Where the membranes of a case lie, from their meshes: to walls, to each other, to periodic images.
#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "driver/case/case_geometry.hpp"
#include "membrane/placed_surface.hpp"

namespace tanktread::driver {

/// Two membranes where they are nearest, the second one perhaps as a periodic image.
struct Nearest {
  double distance = 0;    ///< of the surfaces, grid steps; 0: they cut through each other
  Eigen::Vector3d place;  ///< midway, where the first membrane is
  Eigen::Vector3i faces;  ///< periodic faces that the second one is moved across, along each axis
  bool first_encloses = false, second_encloses = false;  ///< one lies inside the other
};

/// A periodic image of a membrane, as near as it is to that.
struct OwnImage {
  double distance = 0;  ///< grid steps
  std::string axes;     ///< across whose faces it lies: "x", "x and y"
};

/// The membranes of a case at their places. Not to be asked by two threads at once.
class Placement {
 public:
  /// Gives the mesh of a capsule, closed and wound outwards, whenever it is asked for.
  using MeshOf = std::function<membrane::TriangleMesh(std::size_t capsule)>;

  /// @param the_case must outlive it
  /// @param meshes of its capsules, closed and wound outwards; all are held
  Placement(const Case& the_case, const std::vector<membrane::TriangleMesh>& meshes);
  /// Holds few meshes at a time: those of capsules that are near to each other are asked for again.
  /// @param boxes around the nodes of each capsule
  Placement(const Case& the_case, std::vector<Eigen::AlignedBox3d> boxes, MeshOf mesh_of);

  std::size_t size() const { return boxes_.size(); }

  /// How far a membrane reaches from the position of its capsule.
  Extent extent(std::size_t capsule, int axis) const;

  /// Where two different membranes are nearest, of all their periodic images. Nothing: nowhere nearer than
  /// `within`, grid steps, and neither lies inside the other.
  std::optional<Nearest> nearest(std::size_t first, std::size_t second, double within) const;

  /// The periodic images of a membrane that are nearer to it than `within`: those along each axis, and such
  /// across several faces as are nearer than those along the axes alone.
  std::vector<OwnImage> images(std::size_t capsule, double within) const;

 private:
  std::optional<Nearest> nearest_at(std::size_t first, std::size_t second, const Eigen::Vector3i& faces,
                                    double within) const;

  using Surface = std::shared_ptr<const membrane::PlacedSurface>;
  Surface surface(std::size_t capsule) const;

  const Case& the_case_;
  std::vector<Eigen::AlignedBox3d> boxes_;
  MeshOf mesh_of_;                                   ///< none: all are in surfaces_
  mutable std::map<std::size_t, Surface> surfaces_;  ///< by capsule
};

/// Refuses membranes without room: those that are no spheres by their meshes, in the words for spheres, which
/// the case holds against each other already (case_geometry.hpp).
/// @throws InputError for a membrane nearer to a wall than the kernel reaches, as long as the way to its own
/// periodic image, or one that cuts through another, touches it or lies inside it; all problems together
void check_placement(const Case& the_case, const Placement& placement);
void check_placement(const Case& the_case, const std::vector<membrane::TriangleMesh>& meshes);

}  // namespace tanktread::driver
