#include <fmt/format.h>

#include "driver/case/schema_keys.hpp"
#include "driver/case/schema_members.hpp"

namespace tanktread::driver {
namespace {

// Objections: why a key has no place in a case. Of meshes they are the same for the mesh and for the shape
// without stress.

const MeshCase& part_of(const CapsuleCase& capsule, const MeshCase&) {
  return capsule.mesh;
}
const StressFreeCase& part_of(const CapsuleCase& capsule, const StressFreeCase&) {
  return capsule.stress_free;
}

template <typename Part>
std::string refuse_shape(const Case& the_case, std::size_t capsule) {
  if (part_of(the_case.capsules[capsule], Part()).file.empty()) return "";
  return "contradicts the file beside it; remove one of them";
}

template <typename Part>
std::string refuse_no_file(const Case& the_case, std::size_t capsule) {
  if (!part_of(the_case.capsules[capsule], Part()).file.empty()) return "";
  return "is empty; give the path of a .vtu, or shape in its place";
}

template <typename Part>
std::string refuse_hash(const Case& the_case, std::size_t capsule) {
  if (!part_of(the_case.capsules[capsule], Part()).file.empty()) return "";
  return "is of the file beside it, which is not given; remove it";
}

template <typename Part>
std::string refuse_unless_spheroid(const Case& the_case, std::size_t capsule) {
  const auto& part = part_of(the_case.capsules[capsule], Part());
  if (!part.file.empty()) return refuse_shape<Part>(the_case, capsule);
  if (part.shape == "spheroid") return "";
  return fmt::format("contradicts shape = \"{}\"; it is of \"spheroid\" only, remove it", part.shape);
}

template <typename Part>
std::string refuse_reduced_volume(const Case& the_case, std::size_t capsule) {
  if (part_of(the_case.capsules[capsule], Part()).aspect_ratio)
    return "contradicts aspect_ratio, from which it follows; remove one of them";
  return refuse_unless_spheroid<Part>(the_case, capsule);
}

std::string refuse_euler_angles(const Case& the_case, std::size_t capsule) {
  if (!the_case.capsules[capsule].mesh.direction) return "";
  return "contradicts mesh.direction; remove one of them";
}

std::string refuse_load_force(const Case& the_case, std::size_t) {
  if (!the_case.si) return "";
  return "contradicts [si], from which it follows; give si.load_force_N";
}

template <auto member>
using InMesh = InCapsule<&CapsuleCase::mesh, member>;
template <auto member>
using InStressFree = InCapsule<&CapsuleCase::stress_free, member>;
template <auto member>
using InLoad = InCapsule<&CapsuleCase::load, member>;

std::vector<Key> mesh_keys() {
  using M = MeshCase;
  const std::string prefix = "capsule.N.mesh.";
  return {
      key<InMesh<&M::shape>>(prefix + "shape", "", "shape made by the program; its axis along z")
          .one_of({"sphere", "biconcave", "spheroid"})
          .unless(refuse_shape<M>),
      key<InMesh<&M::level>>(prefix + "level", "", "20 * 4^level triangles")
          .from(0)
          .to(8)
          .unless(refuse_shape<M>),
      key<InMesh<&M::aspect_ratio>>(prefix + "aspect_ratio", "",
                                    "of a spheroid, its axis over its diameter; or reduced_volume")
          .from(0.1)
          .to(10)
          .unless(refuse_unless_spheroid<M>),
      key<InMesh<&M::reduced_volume>>(prefix + "reduced_volume", "",
                                      "of an oblate spheroid, V over that of the sphere of its area")
          .from(0.5)
          .to(1)
          .unless(refuse_reduced_volume<M>),
      key<InMesh<&M::file>>(
          prefix + "file", "",
          "a closed surface (.vtu) instead, scaled to the radius by its volume; path from the case file")
          .preset("")
          .unless(refuse_no_file<M>)
          .free_on_resume(),
      key<InMesh<&M::file_hash>>(
          prefix + "file_hash", "",
          "of the points and triangles in mesh.file (`tanktread mesh info` says it): a file with another is "
          "refused")
          .preset("")
          .unless(refuse_hash<M>),
      key<InMesh<&M::direction>>(prefix + "direction", "",
                                 "where the mesh's z axis points, by the shortest turn; or euler_angles"),
      key<InMesh<&M::euler_angles>>(prefix + "euler_angles", "degrees",
                                    "turns about z, then about the new x, then about the new z")
          .unless(refuse_euler_angles),
  };
}

std::vector<Key> stress_free_keys() {
  using S = StressFreeCase;
  const std::string prefix = "capsule.N.stress_free.";
  return {
      key<InStressFree<&S::shape>>(prefix + "shape", "",
                                   "shape without stress; mesh: that of the mesh; of its area and turned as "
                                   "it is")
          .one_of({"mesh", "sphere", "biconcave", "spheroid"})
          .unless(refuse_shape<S>),
      key<InStressFree<&S::aspect_ratio>>(prefix + "aspect_ratio", "", "as that of mesh")
          .from(0.1)
          .to(10)
          .unless(refuse_unless_spheroid<S>),
      key<InStressFree<&S::reduced_volume>>(prefix + "reduced_volume", "", "as that of mesh")
          .from(0.5)
          .to(1)
          .unless(refuse_reduced_volume<S>),
      key<InStressFree<&S::file>>(prefix + "file", "",
                                  "a surface (.vtu) of the same triangles instead, scaled to the mesh's area")
          .preset("")
          .unless(refuse_no_file<S>)
          .free_on_resume(),
      key<InStressFree<&S::file_hash>>(prefix + "file_hash", "", "of stress_free.file, as that of mesh")
          .preset("")
          .unless(refuse_hash<S>),
  };
}

std::vector<Key> load_keys() {
  using L = LoadCase;
  const std::string prefix = "capsule.N.load.";
  return {
      key<InLoad<&L::force>>(prefix + "force", "",
                             "F/(G a) that pulls each end outwards, G the modulus of the law; 0: none")
          .unless(refuse_load_force),
      key<InLoad<&L::direction>>(prefix + "direction", "", "the axis that the forces are along"),
      key<InLoad<&L::patch>>(prefix + "patch", "", "area at each end that a force is on, over the whole area")
          .above(0)
          .to(0.5),
      key<InLoad<&L::until>>(prefix + "until", "shear times", "when the forces are switched off; none: never")
          .above(0),
  };
}

}  // namespace

std::vector<Key> capsule_keys() {
  using C = CapsuleCase;
  std::vector<Key> keys = {
      key<InCapsule<&C::radius>>("capsule.N.radius", "grid steps",
                                 "undeformed radius a (of the sphere of equal volume)")
          .above(0)
          .required(),
      key<InCapsule<&C::position>>("capsule.N.position", "grid steps",
                                   "centre; the box goes from 0 to flow.box")
          .required(),
  };
  for (const auto& group : {mesh_keys(), stress_free_keys(), load_keys()})
    keys.insert(keys.end(), group.begin(), group.end());
  keys.push_back(
      key<InCapsule<&C::viscosity_ratio>>("capsule.N.viscosity_ratio", "", "lambda of this capsule")
          .above(0)
          .preset("flow.viscosity_ratio")
          .unless(refuse_beside_inner_viscosity));
  return keys;
}

}  // namespace tanktread::driver
