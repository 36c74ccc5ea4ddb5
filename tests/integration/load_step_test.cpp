// Loads of a case: their size, when they end, what an echo says of them, and their power.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "driver/plan/echo.hpp"
#include "driver/system/capsule_shape.hpp"
#include "driver/system/components.hpp"
#include "driver/system/loads.hpp"
#include "driver/system/step.hpp"
#include "driver/units/load_units.hpp"
#include "driver/units/mesh_axis.hpp"
#include "driver/units/si.hpp"
#include "tests/unit/case_samples.hpp"

namespace {

using namespace tanktread::driver;
using namespace tanktread::testing;
using ::testing::HasSubstr;
using ::testing::Not;

/// 500 steps a shear time.
constexpr const char* stretched_case = R"([flow]
box = [20, 20, 20]
wall_speed = 0.02
[[capsule]]
radius = 4.0
position = [10.0, 10.0, 10.0]
mesh = { level = 2 }
load = { force = 0.5, direction = [0, 2, 0], patch = 0.1, until = 0.0161 }
[membrane]
capillary_number = 0.3
)";

Case stretched(const std::vector<std::string>& assignments = {}) {
  return parse_case(stretched_case, "stretched.toml", "/", assignments);
}

System make(const Case& the_case) {
  const auto p = parameters(the_case);
  return make_system(the_case, p, membrane_shapes(the_case));
}

// Of F/(G_s a) by the law, G_s = E_s/2.
TEST(Loads, AreInUnitsOfTheModulusOfTheLaw) {
  const auto skalak = stretched();
  const auto p = parameters(skalak);
  const double modulus = p.kinematic_viscosity * p.shear_rate * 4 / 0.3;
  EXPECT_NEAR(load_force(skalak.capsules[0], p.capsules[0]), 0.5 * (modulus / 2) * 4, 1e-15 * modulus);
  const auto drop = stretched({"membrane.elastic_law=interfacial-tension"});
  EXPECT_NEAR(load_force(drop.capsules[0], parameters(drop).capsules[0]), 0.5 * modulus * 4, 1e-15 * modulus);
  const auto shapes = membrane_shapes(skalak);
  const auto& mesh = shapes.meshes[0];
  auto membranes = make_membranes(skalak, p, shapes);
  const Eigen::Matrix3Xd forces = membranes[0].load_at(0);
  double ahead = 0;
  for (const auto node : load_patches(skalak.capsules[0].load, mesh).ahead.nodes) {
    EXPECT_GT(mesh.points(1, node), 10);
    ahead += forces(1, node);
  }
  EXPECT_NEAR(ahead, load_force(skalak.capsules[0], p.capsules[0]), 1e-15);
  EXPECT_EQ(forces.row(0).norm(), 0);
  EXPECT_EQ(forces.row(2).norm(), 0);
}

// 0.0161 shear times are 8.05 steps: at the positions of step 8 the load is off.
TEST(Loads, EndWithTheNearestWholeStep) {
  const auto the_case = stretched();
  EXPECT_EQ(load_end(the_case.capsules[0].load, flow_parameters(the_case)), 8);
  auto system = make(the_case);
  for (int step = 1; step <= 10; ++step) {
    advance(system);
    const auto& membrane = system.membranes[0];
    const Eigen::Matrix3Xd rest = system.node_force[0] - membrane.elastic_forces();
    const auto load = membrane.load_at(step);
    EXPECT_EQ(load.norm() > 0, step < 8) << step;
    EXPECT_LT((rest - load).cwiseAbs().maxCoeff(), 1e-14 * system.node_force[0].cwiseAbs().maxCoeff())
        << step;
  }
  const auto flow = flow_parameters(the_case);
  EXPECT_EQ(load_end(stretched({"capsule.0.load.until=1e-9"}).capsules[0].load, flow), 1);
  EXPECT_GT(load_end(stretched({"capsule.0.load.until=1e30"}).capsules[0].load, flow), 9'999'999'999);
  EXPECT_GT(load_end(LoadCase(), flow), 9'999'999'999);
}

// It pulls along y, and the fluid goes with it.
TEST(Loads, StretchACapsule) {
  for (const double sign : {1.0, -1.0}) {
    auto system = make(stretched({"capsule.0.load.until=1", "flow.wall_speed=0.0002",
                                  sign > 0 ? "capsule.0.load.force=0.5" : "capsule.0.load.force=-0.5"}));
    const auto start = system.membranes[0].positions();
    for (int step = 0; step < 200; ++step) advance(system);
    const Eigen::Matrix3Xd moved = system.membranes[0].positions() - start;
    Eigen::Index top = 0;
    start.row(1).maxCoeff(&top);
    EXPECT_GT(sign * moved(1, top), 1e-4);
    EXPECT_LT((moved.rowwise().mean()).norm(), 1e-3 * moved(1, top) * sign) << "it stays where it is";
  }
}

TEST(Loads, GoFromNewtonAndBack) {
  const auto the_case = parse(si_case, {"si.load_force_N=4e-11"});
  const auto& si = *the_case.si;
  // Both capsules have the same force, so that the smaller one is pulled more.
  EXPECT_NEAR(the_case.capsules[0].load.force, 4e-11 / (*si.shear_modulus_N_per_m * si.radius_m), 1e-12);
  const double ratio = the_case.capsules[0].radius / the_case.capsules[1].radius;
  EXPECT_NEAR(the_case.capsules[1].load.force, ratio * the_case.capsules[0].load.force, 1e-12);
  const auto p = parameters(the_case);
  EXPECT_NEAR(*si_of(the_case, p, *si_scales(the_case, p)).load_force_N, 4e-11, 1e-24);
  EXPECT_FALSE(si_of(parse(si_case), p, *si_scales(the_case, p)).load_force_N);
}

TEST(Loads, AreInTheEcho) {
  const auto the_case = stretched();
  const auto p = parameters(the_case);
  const auto meshes = membrane_shapes(the_case).meshes;
  const auto text =
      echo(the_case, p, {}, {}, {{.mean_edge = 1.0}}, {load_patches_of(the_case.capsules[0], meshes[0])});
  for (const char* row : {"load F/(G a)", "load F ", "load along", "load until", "step 8", "patch ahead",
                          "patch behind", "of the area", "load moment"})
    EXPECT_THAT(text, HasSubstr(row));
  const auto none = stretched({"capsule.0.load.force=0"});
  EXPECT_THAT(echo(none, p, {}, {}, {{.mean_edge = 1.0}}, {load_patches_of(none.capsules[0], meshes[0])}),
              Not(HasSubstr("load ")));
}

// Turned by mesh.direction, or about z, the new x, the new z: Rz(a) Rx(b) Rz(c) z.
TEST(MeshAxis, IsWhereZIsTurnedTo) {
  MeshCase mesh;
  EXPECT_EQ(mesh_axis(mesh), Eigen::Vector3d::UnitZ());
  mesh.direction = {0, 3, 4};
  EXPECT_LT((mesh_axis(mesh) - Eigen::Vector3d(0, 0.6, 0.8)).norm(), 1e-15);
  mesh.direction.reset();
  mesh.euler_angles = {20, 50, 70};
  const auto about = [](const Eigen::Vector3d& axis, double degrees) {
    return Eigen::AngleAxisd(degrees * std::acos(-1.0) / 180, axis).toRotationMatrix();
  };
  const auto x = Eigen::Vector3d::UnitX(), z = Eigen::Vector3d::UnitZ();
  EXPECT_LT((mesh_axis(mesh) - about(z, 20) * about(x, 50) * about(z, 70) * z).norm(), 1e-15);
}

}  // namespace
