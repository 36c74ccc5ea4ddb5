// Membranes from files have the room that spheres must have: by their meshes, in the same words.
#include "driver/system/placement.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <numbers>

#include "driver/plan/warnings.hpp"
#include "driver/system/capsule_shape.hpp"
#include "driver/system/components.hpp"
#include "tests/integration/program.hpp"
#include "tests/unit/case_samples.hpp"

namespace {

using namespace tanktread::driver;
using namespace tanktread::testing;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using Meshes = std::vector<tanktread::membrane::TriangleMesh>;

/// Two capsules in a box of 80 x 40 x 32 with walls across z; 1000 steps a shear time, so that no interval is
/// rounded.
const std::string two_capsules = R"([flow]
box = [80, 40, 32]
wall_speed = 0.016
relaxation_time = 1.5
[[capsule]]
radius = 5
position = [20, 20, 16]
[[capsule]]
radius = 5
position = [50, 20, 16]
[membrane]
capillary_number = 0.3
)";

/// The case with meshes from files, each an ellipsoid of semi-axes `stretch` times the radius.
struct Files {
  Case the_case;
  Meshes meshes;

  Files(std::vector<std::string> assignments, const Eigen::Vector3d& stretch) {
    const TemporaryDirectory directory;
    const auto file = (directory / "cell.vtu").string();
    std::ofstream(file) << "looked for, not read";
    for (const char* capsule : {"capsule.0", "capsule.1"})
      assignments.push_back(capsule + (".mesh.file=" + file));
    the_case = parse(two_capsules, assignments);
    for (const auto& capsule : the_case.capsules) {
      const Eigen::Vector3d place(capsule.position[0], capsule.position[1], capsule.position[2]);
      auto mesh = tanktread::membrane::icosphere(3, capsule.radius);
      mesh.points = (stretch.asDiagonal() * mesh.points).colwise() + place;
      meshes.push_back(mesh);
    }
  }
  /// That of all meshes, which one that asks for each of them again gives too.
  std::string refusal() const {
    const auto text = refusal_of(Placement(the_case, meshes));
    EXPECT_EQ(refusal_of(asking()), text);
    return text;
  }
  std::vector<std::string> warnings() const {
    const auto lines = warnings_of(Placement(the_case, meshes));
    EXPECT_EQ(warnings_of(asking()), lines);
    return lines;
  }

 private:
  Placement asking() const {
    std::vector<Eigen::AlignedBox3d> boxes;
    for (const auto& mesh : meshes)
      boxes.emplace_back(mesh.points.rowwise().minCoeff(), mesh.points.rowwise().maxCoeff());
    return Placement(the_case, boxes, [this](std::size_t k) { return meshes[k]; });
  }
  std::string refusal_of(const Placement& placement) const {
    try {
      check_placement(the_case, placement);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }
  std::vector<std::string> warnings_of(const Placement& placement) const {
    return tanktread::driver::warnings(the_case, parameters(the_case), {}, placement);
  }
};

struct RefusedPlace {
  Eigen::Vector3d stretch;
  std::vector<std::string> fine, refused;
  std::vector<std::string> words;
};

TEST(Placement, RefusesOneOnEachSideOfItsBound) {
  // The kernel reaches 3. An ellipsoid has nodes at the ends of its axes.
  const Eigen::Vector3d disc(2, 1, 0.5), sphere(1, 1, 1), tall(1, 1, 2);
  const std::vector<RefusedPlace> all = {
      {disc,
       {"capsule.0.position.2=5.5"},
       {"capsule.0.position.2=5.4"},
       {"capsule.0.position = [20, 20, 5.4]: leaves 2.9 grid steps between capsule and wall",
        "z must be from 5.5 to 26.5", "or coupler.kernel = \"peskin4\", which reaches 2"}},
      {disc, {"capsule.0.position.2=5.4", "coupler.kernel=peskin4"}, {}, {}},
      {tall,
       {},
       {"flow.box.2=25", "capsule.0.position.2=12.5", "capsule.1.position.2=12.5"},
       {"2 problems", "flow.box along z must be at least 26, or the radius at most 4.75"}},
      {disc,
       {"flow.box.0=40", "flow.box.1=80", "capsule.1.position=[20, 60, 16]", "capsule.1.radius=9.9"},
       {"flow.box.0=40", "flow.box.1=80", "capsule.1.position=[20, 60, 16]", "capsule.1.radius=10.1"},
       {"capsule.1.radius = 10.1: the capsule is 40.4 grid steps long, but its own periodic image only 40 "
        "away "
        "along x; make the radius less than "}},
      {disc,
       {"capsule.1.position.0=40.01"},
       {"capsule.1.position.0=39.99"},
       {"capsule.1.position = [39.99, 20, 16]: overlaps capsule 0: their surfaces meet about (30, ",
        "move one of them, or make one smaller"}},
      {disc,
       {"capsule.1.position=[20, 20, 21.01]"},
       {"capsule.1.position=[20, 20, 20.99]"},
       {"overlaps capsule 0: their surfaces meet about"}},
      {sphere, {"capsule.1.position.0=30.01"}, {"capsule.1.position.0=29.99"}, {"overlaps capsule 0"}},
      {sphere,
       {"capsule.0.position.0=2", "capsule.1.position.0=71.9"},
       {"capsule.0.position.0=2", "capsule.1.position.0=72.1"},
       {"overlaps capsule 0 across a periodic face: their surfaces meet about (77"}},
      {sphere,
       {},
       {"capsule.1.position.0=21", "capsule.1.radius=2"},
       {"lies inside capsule 0: their surfaces are"}},
      {sphere, {}, {"capsule.0.position.0=51", "capsule.0.radius=2"}, {"holds capsule 0 inside it"}},
  };
  for (const auto& row : all) {
    EXPECT_EQ(Files(row.fine, row.stretch).refusal(), "");
    const auto refusal = Files(row.refused, row.stretch).refusal();
    for (const auto& word : row.words) EXPECT_THAT(refusal, HasSubstr(word));
  }
}

TEST(Placement, WarnsOfASphereFromAFileAsOfASphere) {
  for (const std::vector<std::string>& assignments : std::vector<std::vector<std::string>>{
           {},
           {"capsule.0.position.2=9.75"},
           {"flow.box.1=14", "capsule.0.position.1=7", "capsule.1.position.1=7"},
           {"capsule.1.position.0=33.5"},
           {"capsule.0.position.0=1", "capsule.1.position.0=68"}}) {
    const auto the_case = parse(two_capsules, assignments);
    const auto of_spheres =
        warnings(the_case, parameters(the_case), {}, Placement(the_case, membrane_shapes(the_case).meshes));
    EXPECT_EQ(of_spheres.empty(), assignments.empty());
    EXPECT_EQ(Files(assignments, {1, 1, 1}).warnings(), of_spheres);
  }
}

TEST(Placement, WarnsByTheDistanceOfTheMeshes) {
  // Discs of semi-axes 10, 5, 2.5: 16 - 2.5 = 13.5 to the walls, which is far; 40 - 10 = 30 to the images.
  const Eigen::Vector3d disc(2, 1, 0.5);
  EXPECT_THAT(Files({}, disc).warnings(), IsEmpty());
  // One above the other, the spheres of their radius would overlap.
  EXPECT_THAT(Files({"capsule.1.position=[20, 20, 25.5]", "capsule.0.position.2=14.4"}, disc).warnings(),
              ::testing::Contains(HasSubstr("capsules 0 and 1 are 6.1 grid steps apart")).Times(0));
  EXPECT_THAT(Files({"capsule.1.position=[20, 20, 24]"}, disc).warnings(),
              ::testing::Contains(HasSubstr("capsules 0 and 1 are 3 grid steps apart")));
  // Side by side, the spheres would be 13 apart.
  EXPECT_THAT(Files({"capsule.1.position.0=43"}, disc).warnings(),
              ::testing::ElementsAre(HasSubstr("capsules 0 and 1 are 3 grid steps apart")));
  EXPECT_THAT(
      Files({"flow.box.1=80", "flow.box.0=24", "capsule.1.position=[20, 60, 16]"}, disc).warnings(),
      ::testing::ElementsAre(HasSubstr("capsule 0 is 0.8 radii from its periodic image along x, less"),
                             HasSubstr("capsule 1 is 0.8 radii from its periodic image along x, less")));
}

TEST(Placement, ALongCellMayBeNearestToItsImageAcrossTwoFaces) {
  Files files({"flow.box=[32, 32, 32]", "capsule.0.position=[16, 16, 16]", "capsule.1.position=[16, 16, 27]",
               "capsule.1.radius=2"},
              {1, 1, 1});
  // A rod of half length 20 along the diagonal of x and y: 28.3 long along each of them, nearest to its image
  // tip to tip, 32 sqrt(2) - 40 = 5.25 away.
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.25 * std::numbers::pi, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  auto rod = tanktread::membrane::icosphere(3, 1);
  rod.points =
      (turn * Eigen::Vector3d(20, 1, 1).asDiagonal() * rod.points).colwise() + Eigen::Vector3d(16, 16, 16);
  files.meshes[0] = rod;
  files.the_case.capsules[0].radius = 10;
  EXPECT_EQ(files.refusal(), "");
  EXPECT_THAT(
      files.warnings(),
      ::testing::Contains(HasSubstr("capsule 0 is 0.525 radii from its periodic image along x and y")));
}

}  // namespace
