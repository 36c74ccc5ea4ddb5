// The shapes of a capsule by its case: the mesh that it starts as, and the one without stress.
#pragma once

#include <string>
#include <vector>

#include "driver/case/case.hpp"
#include "driver/packets/membrane_shapes.hpp"

namespace tanktread::driver {

/// The mesh of a capsule as it starts, its nodes in the stress-free shape, and the hashes of the files that
/// they were made of ("": of none).
struct CapsuleShape {
  membrane::TriangleMesh mesh;
  Eigen::Matrix3Xd stress_free;
  std::string mesh_hash, stress_free_hash;
};

/// The shapes of a capsule at its place in the box.
///
/// The mesh is an icosphere() of the radius; or a revolved_mesh() of the meridian that has the volume of a
/// sphere of the radius (the triangles, chords of it, enclose a little less, as with the sphere); or a file
/// scaled so that its triangles enclose that volume. It is turned about its centre, which is the capsule's
/// position, of a file the centroid of the volume.
///
/// The stress-free shape (CapsuleCase::stress_free) has the same triangles. It is scaled so that they have
/// the area of those of the mesh, turned as the mesh, and has its centre there.
/// @throws InputError if a file is not a surface that can be a membrane, or the state of a deformed one whose
/// shape would be taken as stress-free, or has another hash than the case says; or if the stress-free one has
/// other triangles
CapsuleShape capsule_shape(const Case& the_case, std::size_t capsule);
/// Those of all capsules. @throws InputError also if one of them has no room (check_placement)
MembraneShapes membrane_shapes(const Case& the_case);

/// What a user should know of the files that stress-free shapes are from, a sentence each: the file is of a
/// run, at a time after its start. @throws InputError if one cannot be read
std::vector<std::string> remarks_on_mesh_files(const Case& the_case);

}  // namespace tanktread::driver
