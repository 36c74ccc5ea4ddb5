// What a capsule starts as, and where it has no stress, by its case.
#include "driver/system/capsule_shape.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <limits>
#include <numbers>

#include "driver/packets/surface_mesh.hpp"
#include "driver/system/components.hpp"
#include "exchange/vtk_files.hpp"
#include "membrane/revolved_mesh.hpp"
#include "membrane/shape.hpp"
#include "tests/integration/program.hpp"
#include "tests/unit/case_samples.hpp"
#include "tests/unit/echo_lines.hpp"

namespace {

using namespace tanktread;
using namespace tanktread::driver;
using namespace tanktread::testing;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

constexpr double epsilon = std::numeric_limits<double>::epsilon();
/// Of a coordinate in the box of least_case: below 44, of a few terms.
constexpr double rounding = 44 * 4 * epsilon;

const Eigen::Vector3d place(18, 20, 22);
constexpr double radius = 6;

CapsuleShape shape_of(const std::vector<std::string>& assignments) {
  return capsule_shape(parse(least_case, assignments), 0);
}

double area(const CapsuleShape& shape, const Eigen::Matrix3Xd& points) {
  return membrane::surface_area(points, shape.mesh.triangles);
}

double largest_difference(const Eigen::Matrix3Xd& a, const Eigen::Matrix3Xd& b) {
  return (a - b).cwiseAbs().maxCoeff();
}

/// A folder with cell.vtu in it: a prolate ellipsoid off the origin, with the triangles of a sphere.
struct CellFile {
  TemporaryDirectory directory;
  membrane::TriangleMesh mesh = membrane::icosphere(2, 1);

  CellFile() {
    mesh.points =
        (Eigen::Vector3d(0.5, 0.8, 1.5).asDiagonal() * mesh.points).colwise() + Eigen::Vector3d(3, -2, 1);
    write("cell.vtu", mesh);
  }
  void write(const std::string& name, const membrane::TriangleMesh& what) const {
    exchange::write_surface(directory / name, surface_packet(what));
  }
  CapsuleShape shape_of(const std::vector<std::string>& assignments) const {
    return capsule_shape(parse_case(least_case, "case.toml", directory.path(), assignments), 0);
  }
  std::string refusal(const std::vector<std::string>& assignments) const {
    try {
      shape_of(assignments);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }
};

TEST(CapsuleShape, ASphereIsTheIcosphereAtItsPlace) {
  const auto shape = shape_of({"capsule.0.mesh.level=2"});
  const auto sphere = membrane::icosphere(2, radius, place);
  EXPECT_TRUE(shape.mesh.points == sphere.points && shape.mesh.triangles == sphere.triangles);
  EXPECT_TRUE(shape.stress_free == shape.mesh.points) << "but for stress_free it has none";
  EXPECT_EQ(shape.mesh_hash + shape.stress_free_hash, "");
}

TEST(CapsuleShape, BiconcaveAndSpheroidHaveTheVolumeOfTheRadius) {
  const std::string spheroid = "capsule.0.mesh={shape = \"spheroid\", level = 2, ";
  const std::pair<std::string, membrane::Meridian> all[] = {
      {"capsule.0.mesh={shape = \"biconcave\", level = 2}", membrane::biconcave_meridian(radius)},
      {spheroid + "aspect_ratio = 2}", membrane::spheroid_meridian(radius, 2)},
      {spheroid + "reduced_volume = 0.8}",
       membrane::spheroid_meridian(radius,
                                   membrane::spheroid_aspect_ratio(0.8, membrane::Spheroid::oblate))}};
  for (const auto& [assignment, meridian] : all) {
    const auto shape = shape_of({assignment});
    const auto mesh = membrane::revolved_mesh(meridian, 2);
    EXPECT_EQ(shape.mesh.triangles, mesh.triangles);
    EXPECT_LT(largest_difference(shape.mesh.points, mesh.points.colwise() + place), rounding) << assignment;
    EXPECT_TRUE(shape.stress_free == shape.mesh.points);
    EXPECT_NEAR(membrane::volume(meridian), 4.0 / 3 * std::numbers::pi * std::pow(radius, 3), 1e-10);
  }
}

TEST(CapsuleShape, IsTurnedAboutItsCentre) {
  const std::string mesh = "capsule.0.mesh={shape = \"biconcave\", level = 2";
  const auto upright = shape_of({mesh + "}"}).mesh.points;
  const auto turned_by = [&](const Eigen::Matrix3d& r) {
    return Eigen::Matrix3Xd((r * (upright.colwise() - place)).colwise() + place);
  };
  const Eigen::Matrix3d z_to_x = Eigen::AngleAxisd(0.5 * std::numbers::pi, Eigen::Vector3d::UnitY()).matrix();
  EXPECT_LT(largest_difference(shape_of({mesh + ", direction = [3, 0, 0]}"}).mesh.points, turned_by(z_to_x)),
            rounding);
  const Eigen::Matrix3d euler = (Eigen::AngleAxisd(std::numbers::pi / 6, Eigen::Vector3d::UnitZ()) *
                                 Eigen::AngleAxisd(std::numbers::pi / 3, Eigen::Vector3d::UnitX()) *
                                 Eigen::AngleAxisd(-std::numbers::pi / 4, Eigen::Vector3d::UnitZ()))
                                    .matrix();
  EXPECT_LT(
      largest_difference(shape_of({mesh + ", euler_angles = [30, 60, -45]}"}).mesh.points, turned_by(euler)),
      rounding);
  // A sphere has no axis, but nodes.
  const auto sphere = shape_of({"capsule.0.mesh={level = 1, direction = [3, 0, 0]}"}).mesh.points;
  const auto plain = membrane::icosphere(1, radius).points;
  EXPECT_LT(largest_difference(sphere, (z_to_x * plain).colwise() + place), rounding);
}

TEST(CapsuleShape, TheStressFreeShapeHasTheAreaTheTurnAndTheCentreOfTheMesh) {
  const std::string mesh = "capsule.0.mesh={shape = \"biconcave\", level = 2, direction = [1, 2, 3]}";
  for (const std::string stress_free :
       {"{shape = \"sphere\"}", "{shape = \"spheroid\", reduced_volume = 0.95}",
        "{shape = \"spheroid\", aspect_ratio = 0.3}", "{shape = \"biconcave\"}"}) {
    const auto shape = shape_of({mesh, "capsule.0.stress_free=" + stress_free});
    // Sums of 320 areas.
    EXPECT_NEAR(area(shape, shape.stress_free) / area(shape, shape.mesh.points), 1, 320 * epsilon)
        << stress_free;
    const auto moments = membrane::volume_moments(shape.stress_free, shape.mesh.triangles);
    EXPECT_LT((moments.centroid - place).norm(), 320 * rounding) << stress_free;
    // Shapes of revolution have the same axis: their second moments have it for an eigenvector.
    const Eigen::Vector3d axis = Eigen::Vector3d(1, 2, 3).normalized();
    const Eigen::Vector3d along = moments.second_moment * axis;
    EXPECT_LT(along.cross(axis).norm(), 1e-9 * along.norm()) << stress_free;
  }
  // The same shape: the mesh itself, but for the rounding of the scale.
  const auto same = shape_of({mesh, "capsule.0.stress_free.shape=biconcave"});
  EXPECT_LT(largest_difference(same.stress_free, same.mesh.points), 320 * rounding);
}

TEST(CapsuleShape, AFileIsScaledByItsVolumeTurnedAndPlaced) {
  const CellFile file;
  const auto shape = file.shape_of({"capsule.0.mesh={file = \"cell.vtu\", direction = [1, 0, 0]}"});
  const auto moments = membrane::volume_moments(shape.mesh.points, shape.mesh.triangles);
  EXPECT_NEAR(moments.volume, 4.0 / 3 * std::numbers::pi * std::pow(radius, 3), 320 * 1e3 * epsilon);
  EXPECT_LT((moments.centroid - place).norm(), 320 * rounding);
  // Its long axis, z in the file, is along x now, its short one along -z.
  const auto upright = file.shape_of({"capsule.0.mesh.file=cell.vtu"}).mesh.points;
  EXPECT_LT(
      (shape.mesh.points.row(0).array() - place[0] - (upright.row(2).array() - place[2])).abs().maxCoeff(),
      rounding);
  EXPECT_LT(
      (shape.mesh.points.row(2).array() - place[2] + (upright.row(0).array() - place[0])).abs().maxCoeff(),
      rounding);
  EXPECT_EQ(shape.mesh_hash, geometry_hash(surface_packet(file.mesh)));
  EXPECT_EQ(shape.stress_free_hash, "");
}

TEST(CapsuleShape, AStressFreeFileHasTheSameTriangles) {
  const CellFile file;
  for (const std::string mesh :
       {"{level = 2}", "{shape = \"biconcave\", level = 2}", "{file = \"cell.vtu\"}"}) {
    const auto shape = file.shape_of({"capsule.0.mesh=" + mesh, "capsule.0.stress_free.file=cell.vtu"});
    EXPECT_EQ(shape.stress_free_hash, geometry_hash(surface_packet(file.mesh)));
    EXPECT_NEAR(area(shape, shape.stress_free) / area(shape, shape.mesh.points), 1, 320 * epsilon) << mesh;
    const auto moments = membrane::volume_moments(shape.stress_free, shape.mesh.triangles);
    EXPECT_LT((moments.centroid - place).norm(), 320 * rounding) << mesh;
  }
  const std::string stress_free = "capsule.0.stress_free.file=cell.vtu";
  EXPECT_THAT(file.refusal({"capsule.0.mesh.level=1", stress_free}),
              AllOf(HasSubstr("cell.vtu: 320 triangles, but the mesh of the capsule has 80"),
                    HasSubstr("capsule.0.stress_free.file must be a surface of the same triangles")));
  auto other = file.mesh;
  other.triangles.col(7).swap(other.triangles.col(8));
  file.write("other.vtu", other);
  EXPECT_THAT(file.refusal({"capsule.0.mesh.level=2", "capsule.0.stress_free.file=other.vtu"}),
              HasSubstr("other.vtu: triangle 7 has the nodes"));
}

TEST(CapsuleShape, AStressFreeFileIsHeldAgainstItsHash) {
  const CellFile file;
  const auto hash = geometry_hash(surface_packet(file.mesh));
  const auto with_hash = [&](const std::string& value) {
    return file.refusal({"capsule.0.mesh.level=2", "capsule.0.stress_free.file=cell.vtu",
                         "capsule.0.stress_free.file_hash=" + value});
  };
  EXPECT_EQ(with_hash(hash), "");
  EXPECT_THAT(with_hash("0123456789abcdef"),
              AllOf(HasSubstr("capsule.0.stress_free.file_hash = \"0123456789abcdef\""), HasSubstr(hash)));
}

TEST(CapsuleShape, ADeformedStateMayBeAStartButNotWithoutStress) {
  CellFile file;
  auto state = surface_packet(file.mesh);
  state.point_data.push_back({"reference_position", 3, to_values(membrane::icosphere(2, 1).points)});
  exchange::write_surface(file.directory / "state.vtu", state);
  const std::string message = "state.vtu: is the state of a deformed membrane";
  EXPECT_THAT(file.refusal({"capsule.0.mesh.file=state.vtu"}), HasSubstr(message));
  EXPECT_THAT(file.refusal({"capsule.0.mesh.level=2", "capsule.0.stress_free.file=state.vtu"}),
              HasSubstr(message));
  EXPECT_EQ(file.refusal({"capsule.0.mesh.file=state.vtu", "capsule.0.stress_free.file=cell.vtu"}), "");
}

TEST(CapsuleShape, AFileOfARunIsRemarkedOnWhereItsShapeIsTakenAsStressFree) {
  CellFile file;
  auto later = surface_packet(file.mesh);
  later.field_data = {{"step", 1, {40}}, {"shear_time", 1, {0.5}}};
  exchange::write_surface(file.directory / "later.vtu", later);
  const auto remarks = [&](const std::vector<std::string>& assignments) {
    return remarks_on_mesh_files(parse_case(least_case, "case.toml", file.directory.path(), assignments));
  };
  EXPECT_THAT(remarks({"capsule.0.mesh.file=later.vtu"}),
              ElementsAre(AllOf(HasSubstr("capsule 0: mesh.file /"), HasSubstr("shear time 0.5"))));
  EXPECT_THAT(remarks({"capsule.0.mesh.level=2", "capsule.0.stress_free.file=later.vtu"}),
              ElementsAre(HasSubstr("capsule 0: stress_free.file /")));
  EXPECT_THAT(remarks({"capsule.0.mesh.file=later.vtu", "capsule.0.stress_free.file=cell.vtu"}), IsEmpty());
}

TEST(CapsuleShape, IsPlacedByItsMeshAndNotByItsRadius) {
  // Its rim is 1.39 radii from its centre, its faces not a third of one: 9 grid steps from a wall is enough
  // for an axis across it, 6 + 3 for a sphere, and not for an axis along it.
  const std::string at = "capsule.0.position=[18, 20, 6]",
                    biconcave = "capsule.0.mesh={shape = \"biconcave\", level = 2";
  EXPECT_THAT(refusal(least_case, {at}), HasSubstr("capsule.0.position"));
  EXPECT_NO_THROW(membrane_shapes(parse(least_case, {at, biconcave + "}"})));
  EXPECT_THROW(membrane_shapes(parse(least_case, {at, biconcave + ", direction = [1, 0, 0]}"})), InputError);
}

TEST(CapsuleShape, AMembraneStartsAsTheMeshAndIsFreeOfStressElsewhere) {
  const auto the_case =
      parse(least_case, {"capsule.0.mesh={shape = \"biconcave\", level = 2}",
                         "capsule.0.stress_free={shape = \"spheroid\", reduced_volume = 0.95}"});
  const auto shapes = membrane_shapes(the_case);
  const auto membranes = make_membranes(the_case, parameters(the_case), shapes);
  EXPECT_TRUE(membranes[0].positions() == shapes.meshes[0].points);
  EXPECT_TRUE(membranes[0].start() == shapes.meshes[0].points);
  EXPECT_TRUE(membranes[0].reference().points == shapes.stress_free[0]);
  EXPECT_GT(membranes[0].elastic_energy(), 0);
}

TEST(CapsuleShape, IsInTheEcho) {
  const auto the_case =
      parse(si_case, {"capsule.0.mesh={shape = \"biconcave\", level = 3, direction = [1, 0, 0]}",
                      "capsule.0.stress_free={shape = \"spheroid\", reduced_volume = 0.95}"});
  const auto text = echo_of(the_case, {}, {shape_numbers(capsule_shape(the_case, 0))});
  EXPECT_EQ(line_of(text, "mesh"), "mesh biconcave, level 3 1280 triangles");
  EXPECT_EQ(line_of(text, "axis along"), "axis along 1, 0, 0 its z, by the shortest turn");
  // 0.6444 of the surface itself; of its triangles some thousandths less.
  EXPECT_THAT(line_of(text, "reduced volume"), HasSubstr("reduced volume 0.64"));
  EXPECT_THAT(line_of(text, "membrane area"), AllOf(HasSubstr(" m^2 "), HasSubstr("of 4 pi a^2")));
  EXPECT_THAT(line_of(text, "stress-free shape"), HasSubstr("spheroid reduced volume 0.94"));
  EXPECT_THAT(echo_of(parse(si_case)), AllOf(Not(HasSubstr("stress-free")), Not(HasSubstr("axis along"))));
}

}  // namespace
